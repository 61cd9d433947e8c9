// A studio that runs, and the commands of the same user that list its sessions, close one, and renew its address.
#include <gmock/gmock.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <functional>
#include <optional>
#include <string>
#include <thread>

#include <nlohmann/json.hpp>

#include "asperity/testkit/temp_dir.h"
#include "asperity/web/assets.h"
#include "make_certificate.h"
#include "raw_client.h"
#include "run_asperity.h"

namespace asperity::cli {
namespace {

using nlohmann::json;
using studio::RawClient;
using testing::HasSubstr;

class StudioSessions : public testing::Test {
 protected:
  void SetUp() override {
    if (!web::built()) GTEST_SKIP() << "built without the studio";
    if (const char* before = std::getenv("XDG_RUNTIME_DIR")) before_ = before;
    setenv("XDG_RUNTIME_DIR", runtime_.path().c_str(), 1);
  }
  void TearDown() override {
    if (before_) {
      setenv("XDG_RUNTIME_DIR", before_->c_str(), 1);
    } else {
      unsetenv("XDG_RUNTIME_DIR");
    }
  }

  // Runs a studio, waits until it is listed, does `work`, and ends it.
  Outcome with_studio(std::vector<std::string> words, const std::function<void(const json& studio)>& work) const {
    words.insert(words.begin(), {"studio", folder_.path().string(), "--no-open"});
    return run_and_meddle(words, [&](pid_t process) {
      const auto until = std::chrono::steady_clock::now() + std::chrono::seconds(30);
      json studios = json::array();
      while (studios.empty() && std::chrono::steady_clock::now() < until) studios = listed();
      if (studios.empty()) {
        ADD_FAILURE() << "no studio is listed";
      } else {
        work(studios[0]);
      }
      ::kill(process, SIGTERM);
    });
  }
  json listed() const { return json::parse(run({"studio", "--sessions", "--json"}).out)["studios"]; }
  static std::string address_in(const Outcome& outcome) { return json::parse(outcome.out)["address"]; }

  testkit::TempDir runtime_, folder_;
  std::optional<std::string> before_;
};

TEST_F(StudioSessions, NoneRuns) {
  const Outcome none = run({"studio", "--sessions"});
  EXPECT_EQ(none.code, 0);
  EXPECT_THAT(none.out, HasSubstr("none is running"));
  for (const std::vector<std::string>& words :
       {std::vector<std::string>{"studio", "--new-token"}, {"studio", "--close-session", "1"}}) {
    const Outcome outcome = run(words);
    EXPECT_EQ(outcome.code, 1);
    EXPECT_THAT(outcome.err, HasSubstr("none of your studios is running"));
  }
  EXPECT_EQ(run({"studio", "--new-token", "--sessions"}).code, 2);
  EXPECT_EQ(run({"studio", "--close-session", "x"}).code, 2);
  EXPECT_EQ(run({"studio", "--close-session", "-1"}).code, 2);
}

TEST_F(StudioSessions, AreListedAndClosedAndRenewed) {
  std::string first_address;
  const Outcome studio = with_studio({}, [&](const json& running) {
    const int port = running["port"];
    EXPECT_EQ(running["folder"], std::filesystem::canonical(folder_.path()).string());
    const std::string address = address_in(run({"studio", "--new-token", "--json"}));
    EXPECT_THAT(address, testing::StartsWith(running["address"].get<std::string>() + "/#token="));
    const std::string cookie = studio::session_cookie(port, address);
    RawClient window = studio::open_websocket(port, cookie);
    window.send(RawClient::frame(1, R"({"id":1,"call":"studio.ping","args":{}})"));
    ASSERT_TRUE(window.next_frame());
    const json sessions = listed()[0]["sessions"];
    ASSERT_EQ(sessions.size(), 1u);
    EXPECT_EQ(sessions[0]["windows"], 1);
    EXPECT_EQ(sessions[0]["from"], "127.0.0.1");
    EXPECT_THAT(run({"studio", "--sessions"}).out, HasSubstr("session    1  opened 20"));

    EXPECT_EQ(run({"studio", "--close-session", "5"}).code, 1);
    const Outcome closed = run({"studio", "--close-session", "1"});
    EXPECT_EQ(closed.code, 0) << closed.err;
    EXPECT_EQ(closed.out, "closed     session 1\n");
    for (;;) {
      const auto frame = window.next_frame();
      ASSERT_TRUE(frame);
      if (frame->opcode != 8) continue;
      EXPECT_EQ(frame->close_code(), 4401);
      break;
    }
    EXPECT_TRUE(listed()[0]["sessions"].empty());

    // The address lets in again; a new one ends it.
    EXPECT_NE(studio::session_cookie(port, address), "");
    const Outcome renewed = run({"studio", folder_.path().string(), "--new-token"});
    EXPECT_EQ(renewed.code, 0) << renewed.err;
    EXPECT_THAT(renewed.out, HasSubstr("studio     http://127.0.0.1:" + std::to_string(port) + "/#token="));
    EXPECT_EQ(studio::session_cookie(port, address), "");
    EXPECT_EQ(run({"studio", "--port", "1", "--new-token"}).code, 1) << "of another port";
    EXPECT_EQ(run({"studio", runtime_.path().string(), "--new-token"}).code, 1) << "of another folder";
    first_address = address;
  });
  EXPECT_THAT(studio.err, HasSubstr("the token was renewed"));
  EXPECT_THAT(studio.out + studio.err, testing::Not(HasSubstr(first_address)));
  EXPECT_TRUE(listed().empty());
}

TEST_F(StudioSessions, SeveralAreToldApart) {
  const testkit::TempDir other;
  with_studio({}, [&](const json& first) {
    run_and_meddle({"studio", other.path().string(), "--no-open"}, [&](pid_t process) {
      const auto until = std::chrono::steady_clock::now() + std::chrono::seconds(30);
      while (listed().size() < 2 && std::chrono::steady_clock::now() < until) continue;
      const Outcome which = run({"studio", "--new-token"});
      EXPECT_EQ(which.code, 1);
      EXPECT_THAT(which.err, HasSubstr("2 of your studios are running; choose one by its folder or --port"));
      const std::string port = std::to_string(first["port"].get<int>());
      EXPECT_THAT(run({"studio", "--port", port, "--new-token"}).out, HasSubstr(":" + port + "/#token="));
      ::kill(process, SIGTERM);
    });
  });
}

TEST_F(StudioSessions, OverTls) {
  const std::string certificate = (runtime_ / "studio.pem").string(), key = (runtime_ / "studio.key").string();
  EXPECT_EQ(run({"studio", folder_.path().string(), "--no-open", "--tls-cert", certificate}).code, 2);
  const Outcome missing =
      run({"studio", folder_.path().string(), "--no-open", "--tls-cert", certificate, "--tls-key", key});
  EXPECT_EQ(missing.code, 1);
  EXPECT_THAT(missing.err, HasSubstr("studio.pem: cannot be read: No such file or directory"));
  studio::make_certificate(certificate, key, {.from_s = -7200, .until_s = -3600});
  const Outcome studio = with_studio({"--tls-cert", certificate, "--tls-key", key}, [&](const json& running) {
    const std::string address = address_in(run({"studio", "--new-token", "--json"}));
    EXPECT_THAT(address, testing::StartsWith("https://127.0.0.1:"));
    const int port = running["port"];
    RawClient window = studio::open_websocket(port, studio::session_cookie(port, address), 0, true);
    window.send(RawClient::frame(1, R"({"id":1,"call":"studio.ping","args":{}})"));
    EXPECT_TRUE(window.next_frame());
  });
  EXPECT_THAT(studio.err, HasSubstr("studio.pem: this certificate has expired; browsers will warn"));
}

}  // namespace
}  // namespace asperity::cli
