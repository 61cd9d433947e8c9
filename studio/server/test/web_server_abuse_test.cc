// What browsers that misbehave can do to the server: nothing that another one would notice.
#include <gmock/gmock.h>

#include <string>
#include <vector>

#include "web_server_fixture.h"

namespace asperity::studio {
namespace {

using testing::HasSubstr;

class WebServerAbuse : public WebServerSocket {
 protected:
  // The close code that some bytes are answered with.
  int code_for(const std::string& bytes) const {
    RawClient client = browser();
    client.send(bytes);
    const auto frame = client.next_frame();
    return frame && frame->opcode == 8 ? frame->close_code() : 0;
  }
};

TEST_F(WebServerAbuse, EndsConnectionsOfMalformedFrames) {
  RawClient good = browser();
  const std::string call = R"({"id":1,"call":"echo","args":{}})";
  EXPECT_EQ(code_for(RawClient::frame(1, call, true, false)), 1002) << "unmasked";
  EXPECT_EQ(code_for(RawClient::frame(3, call)), 1002) << "an opcode that is none";
  EXPECT_EQ(code_for(std::string("\xC1\x80\1\2\3\4", 6)), 1002) << "compressed, which was not agreed";
  EXPECT_EQ(code_for(RawClient::frame(0, call)), 1002) << "the rest of nothing";
  EXPECT_EQ(code_for(RawClient::frame(9, std::string(126, 'p'))), 1002) << "a ping that is too long";
  EXPECT_EQ(code_for(RawClient::frame(1, "\xFF\xFE")), 1007) << "no UTF-8";
  EXPECT_EQ(code_for(RawClient::frame(1, "{")), 1008) << "no JSON";
  EXPECT_EQ(code_for(RawClient::frame(1, R"({"id":1})")), 1008) << "no call";
  EXPECT_EQ(code_for(RawClient::frame(2, "ASP1")), 1008) << "no pointer";
  EXPECT_EQ(code_for(RawClient::frame(2, "")), 1008) << "nothing";
  EXPECT_TRUE(answers(good));
}

TEST_F(WebServerAbuse, EndsConnectionsOfEnormousFrames) {
  const std::string head("\x81\xFF", 2), mask = "\1\2\3\4";
  EXPECT_EQ(code_for(head + std::string("\0\0\0\0\0\x10\0\1", 8) + mask), 1009) << "a byte too long";
  EXPECT_EQ(code_for(head + std::string("\x7F\xFF\xFF\xFF\xFF\xFF\xFF\xFF", 8) + mask), 1009);
  EXPECT_THAT(code_for(head + std::string("\xFF\xFF\xFF\xFF\xFF\xFF\xFF\xFF", 8) + mask), testing::AnyOf(1002, 1009));
  const std::string half(600'000, ' ');
  EXPECT_EQ(code_for(RawClient::frame(1, half, false) + RawClient::frame(0, half)), 1009) << "in two pieces";
}

TEST_F(WebServerAbuse, TakesFramesInPieces) {
  RawClient client = browser();
  const std::string call = R"({"id":1,"call":"echo","args":{}})";
  const std::string bytes = RawClient::frame(1, call.substr(0, 5), false) + RawClient::frame(9, "ping") +
                            RawClient::frame(0, "", false) + RawClient::frame(0, call.substr(5));
  for (const char byte : bytes) client.send({&byte, 1});
  constexpr unsigned kPong = 10;
  EXPECT_EQ(client.next_frame()->opcode, kPong);
  EXPECT_EQ(client.next_frame()->payload, R"({"id":1,"result":{}})");
}

TEST_F(WebServerAbuse, RefusesMalformedRequests) {
  EXPECT_EQ(ask("GET\r\n\r\n").status, 400);
  EXPECT_EQ(ask("GET / HTTP/9.9\r\n\r\n").status, 400);
  EXPECT_EQ(ask("GET / HTTP/1.1\r\nno header\r\n\r\n").status, 400);
  EXPECT_EQ(ask("GET / HTTP/1.1\r\nHost: " + host_ + "\r\nX: " + std::string(9000, 'x') + "\r\n\r\n").status, 431);
  EXPECT_EQ(ask("POST /session HTTP/1.1\r\nHost: " + host_ + "\r\nContent-Length: 99999999999\r\n\r\n").status, 413);
  EXPECT_EQ(ask("POST /session HTTP/1.1\r\nHost: " + host_ + "\r\nTransfer-Encoding: chunked\r\n\r\n2000\r\n" +
                std::string(0x2000, 'x') + "\r\n0\r\n\r\n")
                .status,
            413);
}

TEST_F(WebServerAbuse, EndsConnectionsThatAreHalfOpen) {
  WebServerConfig config;
  config.request_timeout_s = 0.2;
  config.idle_timeout_s = 0.2;
  start(config);
  RawClient silent(port_), slow(port_);
  slow.send("GET / HTTP/1.1\r\nHost: ");
  EXPECT_TRUE(silent.closes());
  EXPECT_TRUE(slow.closes());
  // A WebSocket that answers no ping.
  RawClient dead = browser();
  EXPECT_TRUE(dead.closes());
  // One without a session that does not take its leave.
  RawClient stranger(port_);
  stranger.send(upgrade_request(port_, "Origin: http://" + host_ + "\r\n"));
  EXPECT_TRUE(stranger.closes());
}

TEST_F(WebServerAbuse, EndsConnectionsThatTrickle) {
  WebServerConfig config;
  config.request_timeout_s = 0.3;
  start(config);
  // A request that never ends, however steadily it comes.
  RawClient slow(port_);
  slow.send("GET / HTTP/1.1\r\nHost: " + host_ + "\r\nX: ");
  RawClient good = browser();
  int sent = 0;
  while (slow.send("x")) {
    ASSERT_LT(++sent, 8000) << "as long as a header may be";
    for (int i = 0; i < 10; ++i) ASSERT_TRUE(answers(good));
  }
}

TEST_F(WebServerAbuse, IsFullOfHalfOpenConnectionsForAWhileOnly) {
  WebServerConfig config;
  config.request_timeout_s = 0.5;
  config.max_clients = 2;
  start(config);
  RawClient good = browser();
  std::vector<RawClient> silent;
  for (int i = 0; i < 100; ++i) silent.emplace_back(port_);
  EXPECT_TRUE(answers(good));
  for (RawClient& one : silent) EXPECT_TRUE(one.closes());
  RawClient next = browser();
  EXPECT_TRUE(answers(next));
}

TEST_F(WebServerAbuse, AgreesToNoCompression) {
  const std::string headers = "Origin: http://" + host_ + "\r\nCookie: " + cookie_ +
                              "\r\nSec-WebSocket-Extensions: permessage-deflate; client_max_window_bits\r\n";
  RawClient client(port_);
  client.send(upgrade_request(port_, headers));
  const RawClient::Response response = client.response();
  EXPECT_EQ(response.status, 101);
  EXPECT_EQ(response.header("Sec-WebSocket-Extensions"), "");
  // A thousand mebibytes of nothing would be a mebibyte of this.
  std::string bomb = RawClient::frame(2, std::string(1000, '\0'));
  bomb[0] = static_cast<char>(0xC2);  // the first reserved bit: compressed
  client.send(bomb);
  EXPECT_EQ(client.next_frame()->close_code(), 1002);
}

TEST_F(WebServerAbuse, AFloodOfContinuationsHoldsNobodyUp) {
  RawClient good = browser(), bad = browser();
  ASSERT_TRUE(bad.send(RawClient::frame(1, "", false)));
  std::string flood;
  for (int i = 0; i < 10'000; ++i) flood += RawClient::frame(0, "", false);
  for (int i = 0; i < 20; ++i) {
    ASSERT_TRUE(bad.send(flood));
    ASSERT_TRUE(answers(good));
  }
  // With something in each of them they come to the end of a message's size.
  std::string filled;
  for (int i = 0; i < 1100; ++i) filled += RawClient::frame(0, std::string(1000, ' '), false);
  bad.send(filled);
  EXPECT_EQ(bad.next_frame()->close_code(), 1009);
  EXPECT_TRUE(answers(good));
}

TEST_F(WebServerAbuse, AFloodOfPingsHoldsNobodyUp) {
  RawClient good = browser(), bad = browser();
  std::string flood;
  for (int i = 0; i < 1000; ++i) flood += RawClient::frame(9, std::string(100, 'p'));
  constexpr unsigned kPong = 10;
  for (int i = 0; i < 20; ++i) {
    ASSERT_TRUE(bad.send(flood));
    ASSERT_TRUE(answers(good));
    for (int j = 0; j < 1000; ++j) ASSERT_EQ(bad.next_frame()->opcode, kPong);
  }
}

TEST_F(WebServerAbuse, ServesFiftyBrowsers) {
  std::vector<RawClient> clients;
  for (int i = 0; i < 50; ++i) {
    clients.push_back(browser());
    clients.back().send(RawClient::frame(1, R"({"id":1,"call":"subscribe","args":{"topic":"t"}})"));
  }
  for (RawClient& client : clients) EXPECT_EQ(client.next_frame()->payload, R"({"id":1,"result":{}})");
  constexpr int kFrames = 20;
  for (int i = 0; i < kFrames; ++i) {
    server_->publish("t", std::to_string(i) + std::string(10'000, '.'), Delivery::kSeries);
  }
  for (RawClient& client : clients) {
    for (int i = 0; i < kFrames; ++i) ASSERT_THAT(client.next_frame()->payload, testing::StartsWith(std::to_string(i)));
  }
  EXPECT_EQ(server_->dropped_frames(), 0U);
  EXPECT_EQ(joined_, 50);
}

TEST_F(WebServerAbuse, TellsABrowserTooManySo) {
  WebServerConfig config;
  config.max_clients = 2;
  start(config);
  RawClient first = browser(), second = browser();
  ASSERT_TRUE(answers(first) && answers(second));
  RawClient third = browser();
  EXPECT_EQ(third.next_frame()->close_code(), 1013);
  EXPECT_TRUE(answers(first));
}

TEST_F(WebServerAbuse, DropsFramesForABrowserThatDoesNotRead) {
  RawClient deaf = open_websocket(port_, cookie_, 65536);
  RawClient good = browser();
  for (RawClient* client : {&deaf, &good}) {
    client->send(RawClient::frame(1, R"({"id":1,"call":"subscribe","args":{"topic":"t"}})"));
    ASSERT_EQ(client->next_frame()->payload, R"({"id":1,"result":{}})");
  }
  // Each is taken by the good one before the next is sent: what is dropped is the other's.
  constexpr int kFrames = 64;
  const std::string filling(1U << 20U, '.');
  for (int i = 0; i < kFrames; ++i) {
    server_->publish("t", std::to_string(i) + filling, Delivery::kSeries);
    ASSERT_THAT(good.next_frame().value().payload, testing::StartsWith(std::to_string(i)));
  }
  const std::uint64_t dropped = server_->dropped_frames();
  EXPECT_GE(dropped, 30U);
  // What is left of the series is in order, with one gap, and holds no more than 16 MiB, the frame that was under way
  // and what the system keeps for a socket (at most 6 MB).
  std::vector<int> numbers;
  do {
    numbers.push_back(std::stoi(deaf.next_frame().value().payload));
  } while (numbers.back() != kFrames - 1);
  EXPECT_TRUE(std::is_sorted(numbers.begin(), numbers.end()));
  EXPECT_EQ(numbers.size() + dropped, static_cast<std::size_t>(kFrames));
  EXPECT_LE(numbers.size(), 16U + 1U + 6U);
  EXPECT_TRUE(answers(deaf));
}

TEST_F(WebServerAbuse, ABrowserThatGoesWhileItIsAnsweredHarmsNobody) {
  RawClient good = browser();
  for (int i = 0; i < 5; ++i) {
    RawClient client = browser();
    for (int j = 0; j < 5; ++j) client.send(RawClient::frame(1, R"({"id":1,"call":"big","args":{}})"));
  }
  while (left_ < 5) ASSERT_TRUE(answers(good));
  EXPECT_EQ(joined_, 6);
}

TEST_F(WebServerAbuse, CutsOffABrowserThatDoesNotTakeItsAnswers) {
  RawClient deaf = open_websocket(port_, cookie_, 65536);
  RawClient good = browser();
  for (int i = 0; i < 80; ++i) deaf.send(RawClient::frame(1, R"({"id":1,"call":"big","args":{}})"));
  while (left_ < 1) ASSERT_TRUE(answers(good));
}

TEST_F(WebServerAbuse, BoundsCallsThatAreNotAnswered) {
  RawClient client = browser();
  for (int i = 0; i < 1000; ++i) client.send(RawClient::frame(1, R"({"id":1,"call":"never","args":{}})"));
  client.send(RawClient::frame(1, R"({"id":2,"call":"echo","args":{}})"));
  EXPECT_THAT(client.next_frame()->payload, HasSubstr(R"({"id":2,"error":{"message":"more than 1000 calls)"));
}

// Almost a mebibyte: five are more than four mebibytes, four are not.
std::string long_call(int id) {
  return RawClient::frame(
      1, R"({"id":)" + std::to_string(id) + R"(,"call":"never","args":{"a":")" + std::string(1'048'000, '.') + "\"}}");
}

TEST_F(WebServerAbuse, ReadsNoMoreWhileMebibytesOfCallsWait) {
  RawClient client = browser();
  while (newest_ == 0) ASSERT_TRUE(client.send(RawClient::frame(9, "")));
  const ClientId id = newest_;
  RawClient good = browser();
  for (int i = 1; i <= 5; ++i) client.send(long_call(i));
  client.send(RawClient::frame(1, R"({"id":6,"call":"echo","args":{}})"));
  while (unanswered_ < 5) ASSERT_TRUE(answers(good));
  for (int i = 0; i < 20; ++i) ASSERT_TRUE(answers(good));
  // An answer without a call makes no room.
  server_->answer(id, 77, "none");
  server_->answer(id, 3, "third");
  const auto next_text = [&client] {
    for (;;) {
      const auto frame = client.next_frame();
      if (!frame) return std::string();
      if (frame->opcode == 1) return frame->payload;
    }
  };
  EXPECT_EQ(next_text(), R"({"id":77,"result":"none"})");
  EXPECT_EQ(next_text(), R"({"id":3,"result":"third"})");
  EXPECT_EQ(next_text(), R"({"id":6,"result":{}})");
}

TEST_F(WebServerAbuse, EndsAConnectionWhoseCallsAreNeverAnswered) {
  WebServerConfig config;
  config.idle_timeout_s = 0.5;
  start(config);
  RawClient client = browser();
  for (int i = 1; i <= 6; ++i) client.send(long_call(i));
  EXPECT_TRUE(client.closes());
  RawClient good = browser();
  while (left_ < 1) ASSERT_TRUE(answers(good));
  EXPECT_EQ(unanswered_, 5);
}

TEST_F(WebServerAbuse, AnExceptionFreesThePlaceOfItsConnection) {
  WebServerConfig config;
  config.max_clients = 1;
  start(config);
  joining_fails_ = true;
  for (int i = 0; i < 3; ++i) EXPECT_TRUE(browser().closes());
  joining_fails_ = false;
  RawClient good = browser();
  EXPECT_TRUE(answers(good));
  EXPECT_EQ(left_, 3);
}

TEST_F(WebServerAbuse, BoundsTopics) {
  RawClient client = browser();
  const auto subscribe = [&client](const std::string& args) {
    client.send(RawClient::frame(1, R"({"id":1,"call":"subscribe","args":)" + args + "}"));
    return client.next_frame()->payload;
  };
  for (int i = 0; i < 64; ++i)
    ASSERT_THAT(subscribe(R"({"topic":"t)" + std::to_string(i) + "\"}"), HasSubstr("result"));
  EXPECT_THAT(subscribe(R"({"topic":"t64"})"), HasSubstr("64 topics at most"));
  EXPECT_THAT(subscribe(R"({"topic":"t63"})"), HasSubstr("result")) << "has it already";
  EXPECT_THAT(subscribe(R"({"topic":"T"})"), HasSubstr("not the name of a topic"));
  EXPECT_THAT(subscribe(R"({"topic":""})"), HasSubstr("not the name of a topic"));
  EXPECT_THAT(subscribe(R"({"topic":7})"), HasSubstr("needs a topic"));
  EXPECT_THAT(subscribe(R"({"topic":"t","x":1})"), HasSubstr("needs a topic"));
}

}  // namespace
}  // namespace asperity::studio
