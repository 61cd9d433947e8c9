// The server with a certificate: what it takes for one, and who gets through the handshake.
#include <gmock/gmock.h>
#include <openssl/ssl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <chrono>
#include <ctime>
#include <string>
#include <vector>

#include "asperity/base/csv.h"
#include "asperity/base/error.h"
#include "asperity/base/output.h"
#include "asperity/testkit/temp_dir.h"
#include "make_certificate.h"
#include "server_limits.h"
#include "tls_context.h"
#include "web_server_fixture.h"

namespace asperity::studio {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::ThrowsMessage;

std::string read_text(const fs::path& path) { return read_file(path, 1U << 20U); }

class TlsFiles : public testing::Test {
 protected:
  void SetUp() override { make_certificate(certificate_, key_); }
  std::vector<std::string> load(const std::string& host = "127.0.0.1") const {
    return load_tls(certificate_, key_, host, std::time(nullptr)).warnings;
  }
  void expect_refused(const std::string& words) const {
    EXPECT_THAT([this] { load(); }, ThrowsMessage<Error>(HasSubstr(words)));
  }

  testkit::TempDir dir_;
  const fs::path certificate_ = dir_ / "server.pem", key_ = dir_ / "server.key";
};

TEST_F(TlsFiles, AreTaken) {
  EXPECT_THAT(load(), testing::IsEmpty());
  EXPECT_THAT(load("localhost"), testing::IsEmpty());
  EXPECT_THAT(load("0.0.0.0"), testing::IsEmpty());
  // With the authorities behind it.
  make_certificate(dir_ / "other.pem", dir_ / "other.key");
  write_file(certificate_, read_text(certificate_) + "words between\n" + read_text(dir_ / "other.pem"));
  EXPECT_THAT(load(), testing::IsEmpty());
}

TEST_F(TlsFiles, WarnOfWhatBrowsersWillNotTake) {
  EXPECT_THAT(load("bench.example"),
              testing::ElementsAre(HasSubstr("server.pem: this certificate is not for 'bench.example'")));
  EXPECT_THAT(load("192.168.0.7"), testing::ElementsAre(HasSubstr("not for '192.168.0.7'")));
  make_certificate(certificate_, key_, {.from_s = -7200, .until_s = -3600});
  EXPECT_THAT(load(), testing::ElementsAre(HasSubstr("server.pem: this certificate has expired")));
  make_certificate(certificate_, key_, {.from_s = 3600, .until_s = 7200});
  EXPECT_THAT(load(), testing::ElementsAre(HasSubstr("not valid yet")));
}

TEST_F(TlsFiles, AreRefusedWhereOthersCanReadTheKey) {
  for (const unsigned mode : {0644u, 0604u, 0620u, 0602u, 0601u}) {
    ASSERT_EQ(chmod(key_.c_str(), mode), 0);
    expect_refused("server.key: other users can read or change this key; chmod 600 it");
  }
  ASSERT_EQ(chmod(key_.c_str(), 0400), 0);
  EXPECT_THAT(load(), testing::IsEmpty());
}

TEST_F(TlsFiles, AreRefusedWhereTheyAreNoSuch) {
  make_certificate(dir_ / "other.pem", dir_ / "other.key");
  fs::rename(dir_ / "other.key", key_);
  expect_refused("server.key: does not belong to the certificate");
  fs::rename(certificate_, dir_ / "kept.pem");
  expect_refused("server.pem: cannot be read: No such file");
  fs::create_directory(certificate_);
  expect_refused("server.pem: is not a file");
  fs::remove(certificate_);
  ASSERT_EQ(mkfifo(certificate_.c_str(), 0600), 0);
  expect_refused("server.pem: is not a file");
  fs::remove(certificate_);
  write_file(certificate_, "no PEM\n");
  expect_refused("server.pem: no certificate in PEM form");
  write_file(certificate_, std::string(300'000, '-'));
  expect_refused("server.pem: is longer than 256 KiB");
  write_file(certificate_, read_text(dir_ / "kept.pem").substr(0, 300));
  expect_refused("server.pem: no certificate in PEM form");
  std::string many;
  for (int i = 0; i < 12; ++i) many += read_text(dir_ / "kept.pem");
  write_file(certificate_, many);
  expect_refused("server.pem: more than 10 certificates");
  write_file(certificate_,
             read_text(dir_ / "kept.pem") + "-----BEGIN CERTIFICATE-----\nAAAA\n-----END CERTIFICATE-----\n");
  expect_refused("server.pem: certificate 2 in it is damaged");
  make_certificate(certificate_, key_);
  fs::remove(key_);
  expect_refused("server.key: cannot be read: No such file");
  fs::create_symlink("/dev/null", key_);
  expect_refused("server.key: is not a file");
}

TEST_F(TlsFiles, AreRefusedWhereTheyAreWeakOrLocked) {
  make_certificate(certificate_, key_, {.rsa_bits = 1024});
  expect_refused("server.pem: this certificate is not usable: ee key too small");
  make_certificate(certificate_, key_);
  lock_key(key_, "secret");
  expect_refused("server.key: this key has a password");
}

TEST_F(TlsFiles, UnreadableKeysAreNamed) {
  // The administrator reads everything: as nobody, then.
  constexpr uid_t kNobody = 65534;
  const uid_t self = geteuid();
  fs::permissions(dir_.path(), fs::perms::owner_all | fs::perms::group_exec | fs::perms::others_exec);
  fs::permissions(certificate_, fs::perms::owner_read | fs::perms::group_read | fs::perms::others_read);
  fs::permissions(key_, fs::perms::none);
  ASSERT_TRUE(self != 0 || seteuid(kNobody) == 0);
  expect_refused("server.key: cannot be read: Permission denied");
  ASSERT_TRUE(self != 0 || seteuid(self) == 0);
}

TEST_F(TlsFiles, GoTogether) {
  WebServerConfig config;
  config.tls_certificate = certificate_;
  EXPECT_THAT([&] { WebServer::start(config, {}); }, ThrowsMessage<Error>(HasSubstr("go together")));
}

// The server of the other tests, with a certificate.
class TlsServer : public WebServerSocket {
 protected:
  void SetUp() override {
    make_certificate(dir_ / "server.pem", dir_ / "server.key");
    start(config());
  }
  WebServerConfig config() const {
    WebServerConfig out;
    out.tls_certificate = dir_ / "server.pem";
    out.tls_key = dir_ / "server.key";
    return out;
  }
  testkit::TempDir dir_;
};

TEST_F(TlsServer, GivesASecureCookieToItsOwnPage) {
  EXPECT_THAT(server_->address(), testing::StartsWith("https://127.0.0.1:"));
  EXPECT_THAT(cookie_, testing::StartsWith("__Host-asperity_" + std::to_string(port_) + "="));
  const std::string body = R"({"token":")" + server_->address().substr(server_->address().find("token=") + 6) + "\"}";
  const auto post = [&](const std::string& origin) {
    return ask("POST /session HTTP/1.1\r\nHost: " + host_ + "\r\nOrigin: " + origin +
               "\r\nContent-Length: " + std::to_string(body.size()) + "\r\n\r\n" + body);
  };
  const auto given = post("https://" + host_);
  EXPECT_EQ(given.status, 204);
  EXPECT_THAT(given.header("Set-Cookie"), testing::EndsWith("; HttpOnly; SameSite=Strict; Path=/; Secure"));
  EXPECT_THAT(given.header("Content-Security-Policy"), HasSubstr("connect-src 'self' wss://" + host_));
  EXPECT_EQ(post("http://" + host_).status, 403);
}

TEST_F(TlsServer, TakesAWebSocketOfItsOwnPageAlone) {
  RawClient client = browser();
  EXPECT_TRUE(answers(client));
  const auto status = [this](const std::string& origin) {
    return ask(upgrade_request(port_, "Origin: " + origin + "\r\nCookie: " + cookie_ + "\r\n")).status;
  };
  EXPECT_EQ(status("https://" + host_), 101);
  EXPECT_EQ(status("http://" + host_), 403);
  EXPECT_EQ(status("https://127.0.0.1"), 403);
  EXPECT_EQ(status("https://evil.example"), 403);
  server_->renew_token();
  EXPECT_EQ(client.next_frame()->close_code(), 4401);
}

TEST_F(TlsServer, SpeaksNothingOlderThanTls12) {
  for (const int version : {TLS1_VERSION, TLS1_1_VERSION}) {
    RawClient client(port_);
    EXPECT_FALSE(client.start_tls(version)) << version;
  }
  for (const int version : {TLS1_2_VERSION, TLS1_3_VERSION}) {
    RawClient client(port_);
    EXPECT_TRUE(client.start_tls(version)) << version;
  }
}

TEST_F(TlsServer, CarriesMuchBothWays) {
  RawClient client = browser();
  const std::string text(1'000'000, 'x');
  client.send(RawClient::frame(1, R"({"id":1,"call":"echo","args":{"a":")" + text + "\"}}"));
  EXPECT_EQ(client.next_frame()->payload, R"({"id":1,"result":{"a":")" + text + "\"}}");
  for (int i = 0; i < 20; ++i) client.send(RawClient::frame(1, R"({"id":1,"call":"big","args":{}})"));
  for (int i = 0; i < 20; ++i) EXPECT_GT(client.next_frame()->payload.size(), 1U << 20U);
  EXPECT_EQ(ask("GET / HTTP/1.1\r\nHost: " + host_ + "\r\nX: " + std::string(9000, 'x') + "\r\n\r\n").status, 431);
  EXPECT_EQ(
      ask("POST /session HTTP/1.1\r\nHost: " + host_ + "\r\nContent-Length: 5000\r\n\r\n" + std::string(5000, 'x'))
          .status,
      413);
}

TEST_F(TlsServer, TellsWhoSpeaksPlainHttp) {
  for (const std::string& request :
       {"GET / HTTP/1.1\r\nHost: " + host_ + "\r\n\r\n", std::string("nonsense\r\n\r\n")}) {
    RawClient client(port_);
    client.send(request);
    const auto answer = client.response();
    EXPECT_EQ(answer.status, 400);
    EXPECT_THAT(answer.body, HasSubstr("speaks https"));
    EXPECT_EQ(answer.header("Set-Cookie"), "");
    EXPECT_TRUE(client.closes());
  }
}

// The beginning of a handshake, as a browser sends it: a head of five bytes and what it announces.
std::string half_a_hello() {
  return std::string("\x16\x03\x01\x01\x00\x01\x00\x00\xFC\x03\x03", 11) + std::string(100, '\7');
}

TEST_F(TlsServer, EndsHandshakesThatDoNotEnd) {
  WebServerConfig quick = config();
  quick.request_timeout_s = 0.3;
  start(quick);
  RawClient good = browser();
  RawClient silent(port_), truncated(port_), trickling(port_);
  truncated.send(half_a_hello());
  const std::string hello = half_a_hello();
  std::size_t sent = 0;
  while (trickling.send(sent < hello.size() ? hello.substr(sent, 1) : std::string(1, '\0'))) {
    ++sent;
    ASSERT_TRUE(answers(good));
  }
  EXPECT_GT(sent, 5u) << "it had time to begin";
  EXPECT_TRUE(silent.closes());
  EXPECT_TRUE(truncated.closes());
  EXPECT_TRUE(answers(good));
}

// Each handshake costs a signature: a flood of them comes one by one, and a window that is connected is answered.
TEST_F(TlsServer, SpreadsHandshakes) {
  RawClient good = browser();
  constexpr int kMany = kMostHandshakesAhead + 12;
  const auto begin = std::chrono::steady_clock::now();
  for (int i = 0; i < kMany; ++i) {
    RawClient client(port_);
    ASSERT_TRUE(client.start_tls());
    ASSERT_TRUE(answers(good));
  }
  EXPECT_GE(std::chrono::steady_clock::now() - begin, (kMany - kMostHandshakesAhead - 1) * kHandshakesApart);
  // Who would have to wait longer than a handshake may take is not kept.
  WebServerConfig quick = config();
  quick.request_timeout_s = 0.3;
  start(quick);
  std::vector<RawClient> many;
  for (int i = 0; i < 40; ++i) {
    many.emplace_back(port_);
    many.back().send(half_a_hello());
  }
  for (RawClient& one : many) EXPECT_TRUE(one.closes());
  // Strangers that have gone leave no queue behind that is longer than that.
  const auto after = std::chrono::steady_clock::now();
  while (!RawClient(port_).start_tls()) ASSERT_LT(std::chrono::steady_clock::now() - after, std::chrono::seconds(5));
}

TEST_F(TlsServer, EndsMalformedHandshakesAtOnce) {
  RawClient good = browser();
  const std::string hello = half_a_hello();
  for (const std::string& bytes : {std::string("\x16\x03\x01\xFF\xFF", 5) + std::string(2000, '\x01'),
                                   std::string("\x16\x03\x01\x00\x40\x02", 6) + std::string(63, '\0'),
                                   hello.substr(0, 11) + std::string(0x100, '\xFF')}) {
    RawClient client(port_);
    client.send(bytes);
    EXPECT_TRUE(client.closes());
    EXPECT_TRUE(answers(good));
  }
}

TEST_F(TlsServer, StopsInTheMiddleOfEverything) {
  RawClient client = browser(), half(port_), silent(port_);
  half.send(half_a_hello());
  ASSERT_TRUE(answers(client));
  server_->stop();
  server_.reset();
  EXPECT_EQ(client.next_frame(), std::nullopt);
  EXPECT_TRUE(half.closes());
}

TEST_F(TlsServer, CutsOffABrowserThatDoesNotTakeItsAnswers) {
  RawClient deaf = open_websocket(port_, cookie_, 65536, true);
  RawClient good = browser();
  for (int i = 0; i < 80; ++i) deaf.send(RawClient::frame(1, R"({"id":1,"call":"big","args":{}})"));
  while (left_ < 1) ASSERT_TRUE(answers(good));
}

}  // namespace
}  // namespace asperity::studio
