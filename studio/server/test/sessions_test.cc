// Who has been let in: the token, the sessions and their end.
#include "sessions.h"

#include <gmock/gmock.h>

#include <string>
#include <vector>

#include "asperity/base/error.h"
#include "server_limits.h"
#include "web_server_fixture.h"

namespace asperity::studio {
namespace {

using testing::HasSubstr;
using testing::MatchesRegex;

TEST(Sessions, HaveACookieEach) {
  Sessions sessions(4);
  const auto first = sessions.admit(sessions.token(), {"127.0.0.1", "Firefox", std::nullopt});
  const auto second = sessions.admit(sessions.token(), {"10.0.0.2", "evil\x1b[31m" + std::string(500, 'x'), "unknown"});
  ASSERT_EQ(first.answer, Sessions::Answer::kWelcome);
  EXPECT_EQ(first.cookie.size(), 32u);
  EXPECT_NE(first.cookie, second.cookie);
  EXPECT_NE(first.cookie, sessions.token());
  EXPECT_EQ(sessions.find(first.cookie), 1u);
  EXPECT_EQ(sessions.find(second.cookie), 2u);
  EXPECT_EQ(sessions.find(sessions.token()), std::nullopt);
  EXPECT_EQ(sessions.find(""), std::nullopt);
  const auto list = sessions.list();
  ASSERT_EQ(list.size(), 2u);
  EXPECT_EQ(list[0].agent, "Firefox");
  EXPECT_EQ(list[1].from, "10.0.0.2");
  EXPECT_THAT(list[0].opened, MatchesRegex("20..-..-..T..:..:..Z"));
  EXPECT_LE(list[1].agent.size(), 110u);
  EXPECT_EQ(list[1].agent.find('\x1b'), std::string::npos);
}

TEST(Sessions, AreForTheTokenAlone) {
  Sessions sessions(4);
  for (const std::string& wrong : {std::string(), std::string(32, '0'), sessions.token() + "0"}) {
    EXPECT_EQ(sessions.admit(wrong, {}).answer, Sessions::Answer::kWrongToken) << wrong;
  }
  EXPECT_TRUE(sessions.list().empty());
}

TEST(Sessions, GoOnWhereTheAddressIsOpenedAgain) {
  Sessions sessions(4);
  const auto first = sessions.admit(sessions.token(), {});
  const auto again = sessions.admit(sessions.token(), {"", "", first.cookie});
  EXPECT_EQ(again.cookie, first.cookie);
  EXPECT_EQ(sessions.list().size(), 1u);
}

TEST(Sessions, AreBounded) {
  Sessions sessions(kMostSessions);
  std::vector<std::string> cookies;
  for (std::size_t i = 0; i < kMostSessions; ++i) cookies.push_back(sessions.admit(sessions.token(), {}).cookie);
  ASSERT_TRUE(sessions.add_window(1, 11, [] {}));
  const auto one_more = sessions.admit(sessions.token(), {});
  EXPECT_EQ(one_more.answer, Sessions::Answer::kWelcome);
  EXPECT_EQ(sessions.list().size(), kMostSessions);
  EXPECT_EQ(sessions.find(cookies[0]), 1u) << "it has a window";
  EXPECT_EQ(sessions.find(cookies[1]), std::nullopt) << "the oldest without one";
  for (std::uint64_t number = 3; number <= kMostSessions + 1; ++number) {
    ASSERT_TRUE(sessions.add_window(number, 100 + number, [] {}));
  }
  EXPECT_EQ(sessions.admit(sessions.token(), {}).answer, Sessions::Answer::kFull);
  sessions.remove_window(11);
  EXPECT_EQ(sessions.admit(sessions.token(), {}).answer, Sessions::Answer::kWelcome);
}

TEST(Sessions, EndOneByOneOrAllTogether) {
  Sessions sessions(4);
  std::vector<int> closed;
  std::vector<std::string> cookies;
  for (int i = 0; i < 3; ++i) {
    cookies.push_back(sessions.admit(sessions.token(), {}).cookie);
    for (const int window : {0, 1}) {
      const int client = 10 * (i + 1) + window;
      ASSERT_TRUE(sessions.add_window(static_cast<std::uint64_t>(i) + 1, static_cast<ClientId>(client),
                                      [&closed, client] { closed.push_back(client); }));
    }
  }
  EXPECT_TRUE(sessions.close(2));
  EXPECT_THAT(closed, testing::ElementsAre(20, 21));
  EXPECT_FALSE(sessions.close(2));
  EXPECT_FALSE(sessions.close(9));
  EXPECT_EQ(sessions.find(cookies[1]), std::nullopt);
  EXPECT_FALSE(sessions.add_window(2, 22, [] {})) << "a WebSocket that was being opened";
  EXPECT_EQ(sessions.session_of(31), 3u);
  EXPECT_EQ(sessions.session_of(20), 0u);
  sessions.remove_window(30);
  const std::string before = sessions.token();
  sessions.renew();
  EXPECT_THAT(closed, testing::ElementsAre(20, 21, 10, 11, 31));
  EXPECT_NE(sessions.token(), before);
  EXPECT_EQ(sessions.admit(before, {}).answer, Sessions::Answer::kWrongToken);
  EXPECT_TRUE(sessions.list().empty());
  sessions.admit(sessions.token(), {});
  EXPECT_EQ(sessions.list().at(0).number, 4u) << "numbers are not given twice";
}

class WebServerSessions : public WebServerSocket {
 protected:
  int status_of_cookie(const std::string& cookie) const {
    RawClient client(port_);
    client.send(upgrade_request(port_, "Origin: http://" + host_ + "\r\nCookie: " + cookie + "\r\n"));
    if (client.response().status != 101) return 0;
    client.send(RawClient::frame(1, R"({"id":1,"call":"echo","args":{}})"));
    const auto frame = client.next_frame();
    return frame && frame->opcode == 8 ? frame->close_code() : 101;
  }
  int status_of_token(const std::string& address) const {
    const std::string body = R"({"token":")" + address.substr(address.find("token=") + 6) + "\"}";
    return ask("POST /session HTTP/1.1\r\nHost: " + host_ + "\r\nOrigin: http://" + host_ +
               "\r\nContent-Length: " + std::to_string(body.size()) + "\r\n\r\n" + body)
        .status;
  }
};

TEST_F(WebServerSessions, AreListedWithTheirWindows) {
  RawClient one = browser(), two = browser();
  const std::string other_cookie = session_cookie(port_, server_->address());
  RawClient other = open_websocket(port_, other_cookie);
  ASSERT_TRUE(answers(one) && answers(two) && answers(other));
  const auto list = server_->sessions();
  ASSERT_EQ(list.size(), 2u);
  EXPECT_EQ(list[0].windows, 2);
  EXPECT_EQ(list[1].windows, 1);
  EXPECT_EQ(list[0].from, "127.0.0.1");
}

TEST_F(WebServerSessions, CloseWithTheirWindowsAndNoOther) {
  RawClient one = browser(), two = browser();
  const std::string other_cookie = session_cookie(port_, server_->address());
  RawClient other = open_websocket(port_, other_cookie);
  ASSERT_TRUE(answers(one) && answers(two) && answers(other));
  EXPECT_FALSE(server_->close_session(77));
  EXPECT_TRUE(server_->close_session(1));
  EXPECT_EQ(one.next_frame()->close_code(), 4401);
  EXPECT_EQ(two.next_frame()->close_code(), 4401);
  EXPECT_EQ(status_of_cookie(cookie_), 4401);
  EXPECT_TRUE(answers(other));
  EXPECT_EQ(left_, 2);
  EXPECT_EQ(status_of_token(server_->address()), 204) << "the address lets in as before";
}

TEST_F(WebServerSessions, EndWithANewToken) {
  RawClient one = browser();
  ASSERT_TRUE(answers(one));
  const std::string before = server_->address();
  server_->renew_token();
  EXPECT_EQ(one.next_frame()->close_code(), 4401);
  EXPECT_EQ(status_of_cookie(cookie_), 4401);
  EXPECT_EQ(status_of_token(before), 403);
  const std::string now = server_->address();
  EXPECT_NE(now, before);
  EXPECT_EQ(now.substr(0, now.find('#')), before.substr(0, before.find('#')));
  const std::string cookie = session_cookie(port_, now);
  EXPECT_NE(cookie, cookie_);
  RawClient again = open_websocket(port_, cookie);
  EXPECT_TRUE(answers(again));
}

// What a closed session had sent before is not heard any more, and nobody is kept waiting by one that does not read.
TEST_F(WebServerSessions, EndHoweverTheirBrowserBehaves) {
  RawClient deaf = open_websocket(port_, cookie_, 65536);
  for (int i = 0; i < 40; ++i) deaf.send(RawClient::frame(1, R"({"id":1,"call":"big","args":{}})"));
  const std::string other_cookie = session_cookie(port_, server_->address());
  RawClient good = open_websocket(port_, other_cookie);
  ASSERT_TRUE(answers(good));
  EXPECT_TRUE(server_->close_session(1));
  while (left_ < 1) ASSERT_TRUE(answers(good));
  EXPECT_EQ(server_->sessions().size(), 1u);
}

// Many threads close, list and renew while browsers come and go.
TEST_F(WebServerSessions, TakeOrdersFromOtherThreads) {
  std::atomic<bool> over{false};
  std::thread orders([&] {
    for (std::uint64_t i = 0; !over; ++i) {
      for (const SessionInfo& session : server_->sessions()) server_->close_session(session.number);
      if (i % 4096 == 0) server_->renew_token();
      std::this_thread::yield();
    }
  });
  int seen = 0;
  for (int i = 0; i < 30; ++i) {
    RawClient client(port_);
    const std::string address = server_->address();
    const std::string cookie = session_cookie(port_, address);
    client.send(upgrade_request(port_, "Origin: http://" + host_ + "\r\nCookie: " + cookie + "\r\n"));
    if (client.response().status != 101) continue;
    ++seen;
    if (i % 2 == 0) {
      EXPECT_EQ(client.next_frame()->close_code(), 4401);
    }
  }
  over = true;
  orders.join();
  EXPECT_GT(seen, 0);
  cookie_ = session_cookie(port_, server_->address());
  RawClient good = browser();
  EXPECT_TRUE(answers(good));
}

}  // namespace
}  // namespace asperity::studio
