// The server over plain sockets: who is let in, and what a browser that is let in gets.
#include <fcntl.h>
#include <gmock/gmock.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include <cstring>
#include <filesystem>
#include <string>
#include <vector>

#include "asperity/base/error.h"
#include "asperity/web/assets.h"
#include "web_server_fixture.h"

namespace asperity::studio {
namespace {

using testing::HasSubstr;

TEST_F(WebServerSocket, PrintsAnAddressWithATokenOf128Bits) {
  EXPECT_THAT(server_->address(), testing::MatchesRegex("http://127.0.0.1:[0-9]+/#token=[0-9a-f]+"));
  EXPECT_EQ(server_->address().size(), ("http://" + host_ + "/#token=").size() + 32);
}

TEST_F(WebServerSocket, AnswersACall) {
  RawClient client = browser();
  client.send(RawClient::frame(1, R"({"id":7,"call":"echo","args":{"a":[1,2.5,"ü"]}})"));
  EXPECT_EQ(client.next_frame()->payload, R"({"id":7,"result":{"a":[1,2.5,"ü"]}})");
}

// The largest message that one window may send does not keep the server from another.
TEST_F(WebServerSocket, AHeartbeatIsAnsweredBesideTheLargestMessage) {
  RawClient busy = browser(), other = browser();
  std::string call = R"({"id":7,"call":"echo","args":{"a":[{})";
  for (int i = 1; i < 199'000; ++i) call += ",{}";
  busy.send(RawClient::frame(1, call + "]}}"));
  for (int beat = 1; beat <= 20; ++beat) {
    const std::string id = std::to_string(beat);
    other.send(RawClient::frame(1, R"({"id":)" + id + R"(,"call":"echo","args":{}})"));
    EXPECT_EQ(other.next_frame()->payload, R"({"id":)" + id + R"(,"result":{}})");
  }
  EXPECT_EQ(busy.next_frame()->payload.size(), std::string(R"({"id":7,"result":{"a":[]}})").size() + 3 * 199'000 - 1);
}

TEST_F(WebServerSocket, SendsATopicToThoseWhoFollowItAlone) {
  RawClient follower = browser(), other = browser();
  follower.send(RawClient::frame(1, R"({"id":1,"call":"subscribe","args":{"topic":"scan.probe"}})"));
  EXPECT_EQ(follower.next_frame()->payload, R"({"id":1,"result":{}})");
  EXPECT_TRUE(server_->has_subscribers("scan.probe"));
  EXPECT_FALSE(server_->has_subscribers("scan.image"));
  const std::string bytes("\0\1\2", 3);
  server_->publish("scan.probe", bytes, Delivery::kSeries);
  server_->broadcast("entries", Json::object());
  const auto frame = follower.next_frame();
  EXPECT_EQ(frame->opcode, 2U);
  EXPECT_EQ(frame->payload, bytes);
  EXPECT_EQ(other.next_frame()->payload, R"({"event":"entries","data":{}})");
  follower.next_frame();
  follower.send(RawClient::frame(1, R"({"id":2,"call":"unsubscribe","args":{"topic":"scan.probe"}})"));
  EXPECT_EQ(follower.next_frame()->payload, R"({"id":2,"result":{}})");
  EXPECT_FALSE(server_->has_subscribers("scan.probe"));
}

TEST_F(WebServerSocket, SaysWhoHasThePort) {
  WebServerConfig config;
  config.port = port_;
  try {
    WebServer::start(config, {});
    FAIL();
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), HasSubstr("another program has this port"));
  }
}

TEST_F(WebServerSocket, RefusesStrangers) {
  const std::string own = "Origin: http://" + host_ + "\r\n", cookie = "Cookie: " + cookie_ + "\r\n";
  const auto status = [this](const std::string& headers) { return ask(upgrade_request(port_, headers)).status; };
  EXPECT_EQ(status(cookie), 403);
  EXPECT_EQ(status(cookie + "Origin: http://127.0.0.1\r\n"), 403);
  EXPECT_EQ(status(cookie + "Origin: null\r\n"), 403);
  EXPECT_EQ(status(cookie + "Origin: https://" + host_ + "\r\n"), 403);
  EXPECT_EQ(status(cookie + "Origin: http://localhost:" + std::to_string(port_) + "\r\n"), 403);
  EXPECT_EQ(status(cookie + "Origin: http://" + host_ + ".evil.example\r\n"), 403);
  EXPECT_EQ(status(cookie + own + own), 403);
  EXPECT_EQ(status(cookie + own + "Host: " + host_ + "\r\n"), 403);
  EXPECT_EQ(status(cookie + own), 101);
}

TEST_F(WebServerSocket, TellsOurOwnPageThatItHasNoSession) {
  for (const std::string& cookie : {std::string(), std::string("Cookie: asperity_1=0\r\n"),
                                    "Cookie: " + cookie_.substr(0, cookie_.size() - 1) + "\r\n"}) {
    RawClient client(port_);
    client.send(upgrade_request(port_, "Origin: http://" + host_ + "\r\n" + cookie));
    EXPECT_EQ(client.response().status, 101);
    // What it sends at once is not heard.
    client.send(RawClient::frame(1, R"({"id":7,"call":"echo","args":{}})"));
    const auto frame = client.next_frame();
    EXPECT_EQ(frame->opcode, 8U);
    EXPECT_EQ(frame->close_code(), 4401);
  }
}

TEST_F(WebServerSocket, GivesTheCookieForTheTokenAlone) {
  const std::string token = server_->address().substr(server_->address().find("token=") + 6);
  const auto post = [this](const std::string& body, const std::string& origin) {
    return ask("POST /session HTTP/1.1\r\nHost: " + host_ + "\r\n" + origin +
               "Content-Length: " + std::to_string(body.size()) + "\r\n\r\n" + body);
  };
  const std::string own = "Origin: http://" + host_ + "\r\n", good = R"({"token":")" + token + R"("})";
  const auto given = post(good, own);
  EXPECT_EQ(given.status, 204);
  EXPECT_THAT(given.header("Set-Cookie"), HasSubstr("; HttpOnly; SameSite=Strict; Path=/"));
  EXPECT_THAT(given.header("Set-Cookie"), testing::Not(HasSubstr(token)));
  EXPECT_EQ(post(good, "").status, 403);
  EXPECT_EQ(post(good, "Origin: http://evil.example\r\n").status, 403);
  EXPECT_EQ(post(R"({"token":"0123456789abcdef0123456789abcdef"})", own).status, 403);
  EXPECT_EQ(post("{", own).status, 400);
  EXPECT_EQ(post(std::string(5000, ' '), own).status, 413);
}

TEST_F(WebServerSocket, KeepsItsSocketsFromChildren) {
  RawClient client = browser();
  ASSERT_TRUE(answers(client));
  // The server's ends alone have its port: a client's has one of its own.
  int own = 0;
  for (const auto& entry : std::filesystem::directory_iterator("/proc/self/fd")) {
    const int file = std::stoi(entry.path().filename().string());
    sockaddr_in address{};
    socklen_t size = sizeof address;
    if (getsockname(file, reinterpret_cast<sockaddr*>(&address), &size) != 0 || address.sin_family != AF_INET) continue;
    if (ntohs(address.sin_port) != port_) continue;
    ++own;
    EXPECT_NE(fcntl(file, F_GETFD) & FD_CLOEXEC, 0);
  }
  EXPECT_EQ(own, 2) << "the one that listens, and the browser's";
}

TEST_F(WebServerSocket, ServesTheAppAndNothingElse) {
  const auto page = get("/");
  EXPECT_EQ(page.status, web::built() ? 200 : 404);
  EXPECT_THAT(page.header("Content-Security-Policy"), HasSubstr("default-src 'none'"));
  EXPECT_EQ(page.header("Referrer-Policy"), "no-referrer");
  for (const char* target : {"/../etc/passwd", "/assets/../../etc/passwd", "/%2e%2e/etc/passwd", "//etc/passwd",
                             "/assets/", "/assets//", "/assets/%00", "/index.html/", "http://127.0.0.1/x", "*"}) {
    EXPECT_EQ(get(target).status, 404) << target;
  }
  // A NUL is not a part of a request's line.
  EXPECT_EQ(get(std::string("/a\0b", 4)).status, 400);
  EXPECT_EQ(get("/session").status, 405);
  EXPECT_EQ(get("/ws").status, 426);
  for (const char* method : {"POST", "PUT", "DELETE", "HEAD", "OPTIONS", "TRACE", "BREW"}) {
    RawClient client(port_);
    client.send(std::string(method) + " / HTTP/1.1\r\nHost: " + host_ + "\r\nContent-Length: 0\r\n\r\n");
    EXPECT_EQ(client.response().status, 405) << method;
  }
}

TEST_F(WebServerSocket, KnowsItsOwnHostsAlone) {
  const auto status = [this](const std::string& hosts) {
    return ask("GET /none HTTP/1.1\r\n" + hosts + "\r\n").status;
  };
  const std::string port = std::to_string(port_);
  EXPECT_EQ(status("Host: localhost:" + port + "\r\n"), 404);
  EXPECT_EQ(status("Host: [::1]:" + port + "\r\n"), 404);
  EXPECT_EQ(status("Host: 127.0.0.1\r\n"), 403);
  EXPECT_EQ(status("Host: evil.example:" + port + "\r\n"), 403);
  // Names that a stranger can have resolved to this machine, and those that only look like ours.
  for (const std::string& name :
       {"127.0.0.1.nip.io:" + port, "localhost.evil.example:" + port, "localhost.:" + port, "127.0.0.2:" + port,
        "127.1:" + port, "2130706433:" + port, "0x7f000001:" + port, "0.0.0.0:" + port, "[::ffff:127.0.0.1]:" + port,
        host_ + ".evil.example", host_ + "@evil.example", "evil.example@" + host_, "user:pass@" + host_,
        "localhost:0" + port, "localhost:" + port + "0", "http://" + host_, host_ + "/", host_ + " evil.example",
        host_ + ",evil.example"}) {
    EXPECT_EQ(status("Host: " + name + "\r\n"), 403) << name;
  }
  EXPECT_EQ(status(""), 403);
  EXPECT_EQ(status("Host: " + host_ + "\r\nHost: " + host_ + "\r\n"), 403);
}

TEST_F(WebServerSocket, TakesAPointer) {
  RawClient client = browser();
  std::string bytes = "ASP1" + std::string(28, '\0');
  bytes[4] = 5;
  client.send(RawClient::frame(2, bytes));
  ASSERT_TRUE(answers(client));
  EXPECT_EQ(pointer_sequence_, 5U);
}

TEST_F(WebServerSocket, StopsWithBrowsersConnected) {
  std::vector<RawClient> clients;
  for (int i = 0; i < 5; ++i) clients.push_back(browser());
  RawClient half_open(port_);
  half_open.send("GET / HT");
  server_->stop();
  server_.reset();
  for (RawClient& client : clients) EXPECT_EQ(client.next_frame(), std::nullopt);
}

}  // namespace
}  // namespace asperity::studio
