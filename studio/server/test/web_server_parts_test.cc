// The server's parts that need no socket.
#include <gmock/gmock.h>

#include <algorithm>
#include <string>
#include <thread>
#include <vector>

#include "asperity/base/error.h"
#include "asperity/studio/web_server.h"
#include "client_table.h"
#include "http_answer.h"
#include "outbox.h"
#include "own_hosts.h"
#include "secret.h"

namespace asperity::studio {
namespace {

OutFrame frame(const std::string& bytes) { return {std::make_shared<const std::string>(bytes), false}; }

std::string popped(Outbox& box) {
  const auto out = box.pop();
  return out ? *out->bytes : "";
}

TEST(WebServerOutbox, KeepsTheNewestPictureInItsPlace) {
  Outbox box;
  box.push_topic("a", frame("a1"), Delivery::kLatest);
  box.push_message(frame("m"));
  box.push_topic("b", frame("b1"), Delivery::kLatest);
  box.push_topic("a", frame("a22"), Delivery::kLatest);
  EXPECT_EQ(box.bytes(), 6U);
  EXPECT_EQ(popped(box), "a22");
  EXPECT_EQ(popped(box), "m");
  box.push_topic("a", frame("a3"), Delivery::kLatest);
  EXPECT_EQ(popped(box), "b1");
  EXPECT_EQ(popped(box), "a3");
  EXPECT_FALSE(box.pop());
  EXPECT_EQ(box.bytes(), 0U);
}

TEST(WebServerOutbox, DropsTheOldestOfASeries) {
  Outbox box;
  const std::string mebibyte(1U << 20U, '.');
  std::size_t dropped = 0;
  for (int i = 0; i < 20; ++i) {
    dropped += box.push_topic("s", frame(std::to_string(i) + mebibyte.substr(2)), Delivery::kSeries);
    if (i == 10) box.push_message(frame("m"));
  }
  EXPECT_EQ(dropped, 4U);
  EXPECT_LE(box.bytes(), kMaxSeriesBytes + 1);
  EXPECT_EQ(std::stoi(popped(box)), 4);
  for (int i = 5; i <= 10; ++i) EXPECT_EQ(std::stoi(popped(box)), i);
  EXPECT_EQ(popped(box), "m");
  EXPECT_EQ(std::stoi(popped(box)), 11);
  box.forget("s");
  EXPECT_FALSE(box.pop());
  EXPECT_EQ(box.push_topic("s", frame(std::string(kMaxSeriesBytes + 1, '.')), Delivery::kSeries), 0U) << "one is kept";
}

TEST(WebServerOutbox, TakesTenThousandAnswersOr64MiB) {
  Outbox many;
  for (int i = 0; i < 10'000; ++i) ASSERT_TRUE(many.push_message(frame("x")));
  EXPECT_FALSE(many.push_message(frame("x")));
  Outbox large;
  ASSERT_TRUE(large.push_message(frame(std::string((64U << 20U) + 1, 'x')))) << "one always fits";
  EXPECT_FALSE(large.push_message(frame("")));
  large.pop();
  EXPECT_TRUE(large.push_message(frame("x")));
}

TEST(WebServerClients, StayWithinTheirMemoryHoweverMuchIsPublished) {
  ClientTable clients(8);
  int woken = 0;
  const ClientId slow = *clients.join([&woken] { ++woken; });
  clients.subscribe(slow, "series");
  clients.subscribe(slow, "picture");
  const std::string bytes(100'000, '.');
  for (int i = 0; i < 1000; ++i) {
    clients.publish("series", bytes, Delivery::kSeries);
    clients.publish("picture", bytes, Delivery::kLatest);
    clients.publish("of nobody", bytes, Delivery::kSeries);
  }
  EXPECT_LE(clients.most_waiting_bytes(), kMaxSeriesBytes + bytes.size());
  EXPECT_EQ(clients.dropped(), 1000 - kMaxSeriesBytes / bytes.size());
  EXPECT_EQ(woken, 1) << "once until it has taken all";
  OutFrame next;
  while (clients.next(slow, next) == ClientTable::State::kFrame) continue;
  clients.publish("picture", bytes, Delivery::kLatest);
  EXPECT_EQ(woken, 2);
  EXPECT_TRUE(clients.leave(slow));
  EXPECT_FALSE(clients.leave(slow));
  EXPECT_FALSE(clients.has_subscribers("series"));
  EXPECT_EQ(clients.next(slow, next), ClientTable::State::kGone);
}

TEST(WebServerClients, AreCutOffWhereAllTogetherAreTooMuch) {
  ClientTable table(20);
  std::vector<ClientId> clients;
  for (int i = 0; i < 20; ++i) clients.push_back(*table.join([] {}));
  // 50 MiB are less than one may have; twenty times are more than all may.
  const std::string answer(10U << 20U, 'a');
  for (int j = 0; j < 5; ++j) {
    for (std::size_t i = 1; i < clients.size(); ++i) {
      table.send(clients[i], answer, true);
      EXPECT_LE(table.all_message_bytes(), ClientTable::kMostMessageBytes);
    }
  }
  table.send(clients[0], "small", true);
  EXPECT_FALSE(table.is_cut(clients[0]));  // not the one who has little
  const auto cut = std::count_if(clients.begin(), clients.end(), [&](ClientId id) { return table.is_cut(id); });
  EXPECT_GE(cut, 1);
  EXPECT_LT(cut, 19);
}

TEST(WebServerClients, AreFullOfCallsUntilTheseAreAnswered) {
  ClientTable clients(8);
  const ClientId id = *clients.join([] {});
  constexpr std::size_t kMiB = 1U << 20U;
  for (const std::uint64_t call : {1, 2, 2, 3}) ASSERT_TRUE(clients.begin_call(id, call, kMiB));
  EXPECT_FALSE(clients.is_full(id));
  ASSERT_TRUE(clients.begin_call(id, 4, 1));
  EXPECT_TRUE(clients.is_full(id));
  clients.end_call(id, 5);
  EXPECT_TRUE(clients.is_full(id)) << "no call of its own";
  clients.end_call(id, 2);
  EXPECT_FALSE(clients.is_full(id));
  ASSERT_TRUE(clients.begin_call(id, 6, kMiB));
  EXPECT_TRUE(clients.is_full(id)) << "one of the two with that number waits still";
  clients.leave(id);
  EXPECT_FALSE(clients.is_full(id));
  EXPECT_FALSE(clients.begin_call(id, 7, 1));
}

TEST(WebServerClients, TakeFromManyThreads) {
  ClientTable clients(8);
  std::vector<ClientId> ids;
  for (int i = 0; i < 4; ++i) {
    ids.push_back(*clients.join([] {}));
    clients.subscribe(ids.back(), "t");
  }
  constexpr int kEach = 500;
  std::vector<std::thread> threads;
  for (int i = 0; i < 3; ++i) {
    threads.emplace_back([&clients] {
      for (int j = 0; j < kEach; ++j) clients.publish("t", "x", Delivery::kSeries);
    });
  }
  std::size_t taken = 0;
  OutFrame next;
  const auto take = [&] {
    for (const ClientId id : ids) {
      while (clients.next(id, next) == ClientTable::State::kFrame) ++taken;
    }
  };
  take();
  for (std::thread& thread : threads) thread.join();
  take();
  EXPECT_EQ(taken, 3U * kEach * ids.size());
}

TEST(WebServerHosts, AreTheLoopbackAndTheOneGiven) {
  const OwnHosts hosts("bench.example", 8137);
  for (const char* own : {"127.0.0.1:8137", "localhost:8137", "LocalHost:8137", "[::1]:8137", "bench.example:8137"}) {
    EXPECT_TRUE(hosts.contains(own)) << own;
  }
  for (const char* foreign : {"", "127.0.0.1", "127.0.0.1:80", "127.0.0.1:81370", "127.0.0.2:8137", "evil.example:8137",
                              "192.168.0.7:8137", "127.0.0.1:8137 ", "x127.0.0.1:8137", "bench.example.:8137"}) {
    EXPECT_FALSE(hosts.contains(foreign)) << foreign;
  }
  EXPECT_EQ(hosts.address(), "http://bench.example:8137");
  EXPECT_TRUE(OwnHosts("127.0.0.1", 80).contains("localhost"));
  EXPECT_EQ(OwnHosts("::1", 8137).address(), "http://[::1]:8137");
}

TEST(WebServerHosts, AtAllAddressesAreNumbers) {
  for (const char* all : {"0.0.0.0", "::"}) {
    const OwnHosts hosts(all, 8137);
    EXPECT_TRUE(hosts.contains("192.168.0.7:8137"));
    EXPECT_TRUE(hosts.contains("[fe80::1]:8137"));
    EXPECT_FALSE(hosts.contains("evil.example:8137"));
    EXPECT_FALSE(hosts.contains("192.168.0.7.evil.example:8137"));
    EXPECT_FALSE(hosts.contains("192.168.0.7:8138"));
    EXPECT_EQ(hosts.address(), "http://127.0.0.1:8137");
  }
}

TEST(WebServerHosts, KnowWhatOnlyThisMachineReaches) {
  for (const char* own : {"127.0.0.1", "127.1.2.3", "localhost", "::1"}) EXPECT_TRUE(is_this_machine_only(own)) << own;
  for (const char* open : {"0.0.0.0", "::", "192.168.0.7", "bench.example", "", "127.0.0.1.example"}) {
    EXPECT_FALSE(is_this_machine_only(open)) << open;
  }
}

TEST(WebServerHosts, HaveOneOrigin) {
  const OwnHosts hosts("127.0.0.1", 8137);
  EXPECT_TRUE(hosts.is_own_origin("http://localhost:8137", "localhost:8137"));
  EXPECT_FALSE(hosts.is_own_origin("http://127.0.0.1:8137", "localhost:8137")) << "another page of ours";
  EXPECT_FALSE(hosts.is_own_origin("https://localhost:8137", "localhost:8137"));
  EXPECT_FALSE(hosts.is_own_origin("http://evil.example:8137", "evil.example:8137"));
  EXPECT_FALSE(hosts.is_own_origin("null", "localhost:8137"));
}

TEST(WebServerSecrets, DifferEachTime) {
  const std::string one = random_secret();
  EXPECT_THAT(one, testing::SizeIs(32));
  EXPECT_EQ(one.find_first_not_of("0123456789abcdef"), std::string::npos);
  EXPECT_NE(one, random_secret());
  EXPECT_TRUE(same_secret("abc", "abc"));
  EXPECT_FALSE(same_secret("abd", "abc"));
  EXPECT_FALSE(same_secret("bbc", "abc"));
  EXPECT_FALSE(same_secret("abcd", "abc"));
  EXPECT_FALSE(same_secret("", "abc"));
}

TEST(WebServerSecrets, AreFoundAmongCookies) {
  EXPECT_EQ(cookie_value("a=1; b=2", "b"), "2");
  EXPECT_EQ(cookie_value("a=1;b=2=3", "b"), "2=3");
  EXPECT_EQ(cookie_value("b=", "b"), "");
  EXPECT_EQ(cookie_value("bb=1; ab=2", "b"), std::nullopt);
  EXPECT_EQ(cookie_value("b=1; b=2", "b"), std::nullopt) << "which one?";
  EXPECT_EQ(cookie_value("; ;=;b", "b"), std::nullopt);
}

class WebServerAnswers : public testing::Test {
 protected:
  HttpAnswer get(const std::string& target, std::optional<std::string> encoding = "br, gzip;q=0.5") {
    HttpRequest request;
    request.method = "GET";
    request.target = target;
    request.host = "localhost:8137";
    request.cookie = "c=secret";
    request.accept_encoding = std::move(encoding);
    return answer_http(request, site_);
  }
  static std::string header(const HttpAnswer& answer, const std::string& name) {
    for (const auto& [key, value] : answer.headers) {
      if (key == name) return value;
    }
    return {};
  }
  Sessions sessions_{2};
  Site site_{OwnHosts("127.0.0.1", 8137), &sessions_, "c",
             [](std::string_view path) -> std::optional<web::Asset> {
               if (path == "/index.html") return web::Asset{"<html>", "text/html", false};
               if (path == "/assets/app.js") return web::Asset{"zipped", "text/javascript", true};
               return std::nullopt;
             },
             [](std::string_view gzip) { return "un" + std::string(gzip); }};
};

TEST_F(WebServerAnswers, AreTheApp) {
  EXPECT_EQ(get("/").body, "<html>");
  EXPECT_EQ(get("/?x").body, "<html>");
  const HttpAnswer script = get("/assets/app.js");
  EXPECT_EQ(script.body, "zipped");
  EXPECT_EQ(header(script, "Content-Encoding"), "gzip");
  EXPECT_EQ(header(script, "Content-Type"), "text/javascript");
  EXPECT_THAT(header(script, "Content-Security-Policy"), testing::HasSubstr("connect-src 'self' ws://localhost:8137"));
  EXPECT_EQ(header(get("/assets/app.js", std::nullopt), "Content-Encoding"), "gzip");
  for (const char* none : {"gzip;q=0", "identity", ""}) {
    EXPECT_EQ(get("/assets/app.js", none).body, "unzipped") << none;
    EXPECT_EQ(header(get("/assets/app.js", none), "Content-Encoding"), "") << none;
  }
  EXPECT_EQ(get("/assets/app.jsx").status, 404U);
}

}  // namespace
}  // namespace asperity::studio
