// The limits of docs/studio-safety.md: the table is that of the code, each row's tests exist, and those that stand
// nowhere else are here. With ASPERITY_WRITE_DOCS=1 the table is written.
#include <gmock/gmock.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "asperity/base/csv.h"
#include "asperity/base/output.h"
#include "asperity/studio/force_lease.h"
#include "limit_table.h"
#include "server_limits.h"
#include "web_server_fixture.h"

namespace asperity::studio {
namespace {

using Clock = std::chrono::steady_clock;
using testing::HasSubstr;
using namespace std::chrono_literals;

TEST(LimitTable, IsThatOfTheDocuments) {
  const std::filesystem::path page = std::filesystem::path(ASPERITY_DOCS) / "studio-safety.md";
  const std::string text = read_file(page, 1U << 20U);
  const std::string first = "<!-- limits: written by LimitTable.IsThatOfTheDocuments -->\n",
                    last = "<!-- end of the limits -->";
  const std::size_t begin = text.find(first), end = text.find(last);
  ASSERT_TRUE(begin != std::string::npos && end != std::string::npos && begin < end) << page;
  const std::string table = text.substr(begin + first.size(), end - begin - first.size());
  if (std::getenv("ASPERITY_WRITE_DOCS") != nullptr) {
    write_file(page, text.substr(0, begin + first.size()) + limit_table() + text.substr(end));
    return;
  }
  EXPECT_EQ(table, limit_table()) << "ASPERITY_WRITE_DOCS=1 studio_test --gtest_filter=LimitTable.* writes it";
}

TEST(LimitTable, NamesTestsThatExist) {
  std::set<std::string> there;
  const testing::UnitTest& all = *testing::UnitTest::GetInstance();
  for (int i = 0; i < all.total_test_suite_count(); ++i) {
    const testing::TestSuite& suite = *all.GetTestSuite(i);
    for (int j = 0; j < suite.total_test_count(); ++j) {
      there.insert(std::string(suite.name()) + "." + suite.GetTestInfo(j)->name());
    }
  }
  for (const LimitRow& row : limit_rows()) {
    EXPECT_FALSE(row.tests.empty()) << row.what;
    for (const std::string& test : row.tests) EXPECT_TRUE(there.contains(test)) << row.what << ": " << test;
  }
}

TEST(ForceLease, EndsWithTheHeartbeats) {
  constexpr std::int64_t kSilence_ns = ForceLease::kSilence_ns;
  ForceLease lease;
  ASSERT_TRUE(lease.acquire(1, 0));
  EXPECT_FALSE(lease.acquire(2, kSilence_ns)) << "one at a time";
  lease.heartbeat(2, kSilence_ns);
  EXPECT_EQ(lease.owner(kSilence_ns), 1u);
  EXPECT_EQ(lease.owner(kSilence_ns + 1), std::nullopt);
  lease.heartbeat(1, kSilence_ns);
  EXPECT_EQ(lease.owner(2 * kSilence_ns), 1u);
  lease.heartbeat(1, 2 * kSilence_ns + 1);
  EXPECT_EQ(lease.owner(2 * kSilence_ns + 1), std::nullopt) << "too late is too late";
  EXPECT_TRUE(lease.acquire(2, 2 * kSilence_ns + 1));
}

class WebServerLimits : public WebServerSocket {
 protected:
  std::string post(const std::string& body) const {
    return "POST /session HTTP/1.1\r\nHost: " + host_ + "\r\nOrigin: http://" + host_ +
           "\r\nContent-Length: " + std::to_string(body.size()) + "\r\n\r\n" + body;
  }
};

TEST_F(WebServerLimits, HeaderAndBody) {
  // Beast counts the line and the fields by themselves: to within 64 bytes.
  constexpr std::size_t kMargin = 64;
  const auto header_of = [this](std::size_t bytes, bool in_line) {
    const std::string rest = "GET /?x HTTP/1.1\r\nHost: " + host_ + "\r\nX: \r\n\r\n";
    const std::string filling(bytes - rest.size(), 'x');
    return "GET /?x" + (in_line ? filling : "") + " HTTP/1.1\r\nHost: " + host_ + "\r\nX: " + (in_line ? "" : filling) +
           "\r\n\r\n";
  };
  for (const bool in_line : {false, true}) {
    EXPECT_NE(ask(header_of(kMostHeaderBytes - kMargin, in_line)).status, 431) << in_line;
    EXPECT_EQ(ask(header_of(kMostHeaderBytes + kMargin, in_line)).status, 431) << in_line;
  }
  EXPECT_EQ(ask(post(std::string(kMostBodyBytes, ' '))).status, 400);
  EXPECT_EQ(ask(post(std::string(kMostBodyBytes + 1, ' '))).status, 413);
}

TEST_F(WebServerLimits, AnAnswerThatIsNotTaken) {
  WebServerConfig config;
  config.request_timeout_s = 0.3;
  start(config);
  RawClient good = browser();
  RawClient deaf(port_, 4096);
  std::string requests;
  for (int i = 0; i < 1000; ++i) requests += "GET /none HTTP/1.1\r\nHost: " + host_ + "\r\n\r\n";
  // Once the system's buffers are full the server waits, and closes; then nothing can be sent any more.
  while (deaf.send(requests)) ASSERT_TRUE(answers(good));
  EXPECT_TRUE(answers(good));
}

TEST_F(WebServerLimits, WhatComesBehindTheLastAnswer) {
  RawClient endless(port_);
  ASSERT_TRUE(endless.send("POST /session HTTP/1.1\r\nHost: " + host_ + "\r\nContent-Length: 999999999\r\n\r\n"));
  EXPECT_EQ(endless.response().status, 413);
  const auto begin = Clock::now();
  std::size_t sent = 0;
  while (endless.send(std::string(65536, 'x'))) sent += 65536;
  // The system's buffers hold some megabytes more than the server takes.
  EXPECT_LT(sent, kMostDrainedBytes + (32U << 20U));
  EXPECT_LT(Clock::now() - begin, 8s) << "before the time of a request is over";
}

TEST_F(WebServerLimits, AWrongTokenIsAnsweredLate) {
  RawClient good = browser();
  RawClient guesser(port_);
  const auto begin = Clock::now();
  guesser.send(post(R"({"token":"00000000000000000000000000000000"})"));
  EXPECT_TRUE(answers(good)) << "nobody else waits";
  EXPECT_EQ(guesser.response().status, 403);
  EXPECT_GE(Clock::now() - begin, kGuessDelay);
}

TEST_F(WebServerLimits, Windows) {
  const int most = WebServerConfig{}.max_clients;
  std::vector<RawClient> windows;
  for (int i = 0; i < most; ++i) {
    windows.push_back(browser());
    ASSERT_TRUE(answers(windows.back()));
  }
  RawClient one_more = browser();
  EXPECT_EQ(one_more.next_frame()->close_code(), 1013);
  EXPECT_TRUE(answers(windows.front()));
}

TEST_F(WebServerLimits, Connections) {
  WebServerConfig config;
  config.max_clients = 1;
  start(config);
  RawClient window = browser();
  // Meanwhile the server sees that the connection by which the cookie was given has gone.
  for (int i = 0; i < 20; ++i) ASSERT_TRUE(answers(window));
  std::vector<RawClient> silent;
  for (int i = 0; i < kMostHttpConnections; ++i) silent.emplace_back(port_);
  // They are accepted in their order: all are there when the last of them is answered.
  silent.back().send("GET /none HTTP/1.1\r\nHost: " + host_ + "\r\n\r\n");
  ASSERT_EQ(silent.back().response().status, 404);
  const auto begin = Clock::now();
  RawClient one_more(port_);
  EXPECT_TRUE(one_more.closes());
  EXPECT_LT(Clock::now() - begin, 5s) << "at once, not after the time of a request";
  EXPECT_TRUE(answers(window));
}

TEST_F(WebServerLimits, Pointers) {
  RawClient client = browser();
  ASSERT_TRUE(answers(client));
  constexpr int kSent = 20'000;
  std::string flood;
  for (int i = 0; i < kSent; ++i) flood += RawClient::frame(2, "ASP1" + std::string(28, '\0'));
  const auto begin = Clock::now();
  client.send(flood);
  ASSERT_TRUE(answers(client));
  const auto took = std::chrono::duration_cast<std::chrono::milliseconds>(Clock::now() - begin);
  EXPECT_GE(pointers_, kMostPointersAhead);
  EXPECT_LE(pointers_, kMostPointersAhead + took / kPointersApart + 2);
}

}  // namespace
}  // namespace asperity::studio
