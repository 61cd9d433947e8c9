#include "asperity/transport/open_udp.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <deque>

#include "asperity/base/host_clock.h"
#include "asperity/testkit/udp_sender.h"

namespace asperity {
namespace {

using namespace std::chrono_literals;
using Bytes = std::vector<std::uint8_t>;
using testing::HasSubstr;
using testing::ThrowsMessage;
using Sender = testkit::UdpSender;

constexpr auto kLong = 20s;

int port_of(const ByteSource& source) { return testkit::port_in(source.name()); }

Bytes read_once(ByteSource& source, std::size_t room = 2000) {
  Bytes buffer(room);
  const Arrival arrival = source.read(buffer, kLong);
  EXPECT_LE(arrival.arrival_ns, host_now_ns());
  buffer.resize(arrival.count);
  return buffer;
}

TEST(Udp, DatagramsComeAndAnswersGoBack) {
  const auto source = open_udp({.address = "127.0.0.1"});
  EXPECT_THAT(source->name(), testing::StartsWith("udp:127.0.0.1:"));
  EXPECT_FALSE(source->write(Bytes{1}));
  const Sender sender;
  sender.send(port_of(*source), {1, 0, 255});
  sender.send(port_of(*source), Bytes(1400, 7));
  EXPECT_EQ(read_once(*source), Bytes({1, 0, 255}));
  EXPECT_EQ(read_once(*source, 1000), Bytes(1000, 7));
  EXPECT_EQ(read_once(*source, 1000), Bytes(400, 7));
  EXPECT_TRUE(source->write(Bytes{9, 8}));
  EXPECT_EQ(sender.receive(), Bytes({9, 8}));
}

TEST(Udp, NothingComesInTime) {
  const auto source = open_udp({.address = "127.0.0.1"});
  Bytes buffer(10);
  EXPECT_EQ(source->read(buffer, 5ms).count, 0u);
  EXPECT_EQ(source->read(buffer, 0ms).count, 0u);
  const Sender sender;
  sender.send(port_of(*source), {5});
  EXPECT_EQ(read_once(*source), Bytes({5}));
}

TEST(Udp, OtherSendersArePassedOver) {
  const auto source = open_udp({.address = "127.0.0.1", .silence_s = 1e6});
  const Sender probe;
  const Sender stranger;
  probe.send(port_of(*source), {1});
  EXPECT_EQ(read_once(*source), Bytes({1}));
  stranger.send(port_of(*source), {66});
  probe.send(port_of(*source), {2});
  EXPECT_EQ(read_once(*source), Bytes({2}));
  EXPECT_TRUE(source->write(Bytes{3}));
  EXPECT_EQ(probe.receive(), Bytes({3}));

  const auto open_to_all = open_udp({.address = "127.0.0.1", .any_sender = true});
  probe.send(port_of(*open_to_all), {1});
  EXPECT_EQ(read_once(*open_to_all), Bytes({1}));
  stranger.send(port_of(*open_to_all), {66});
  EXPECT_EQ(read_once(*open_to_all), Bytes({66}));
}

TEST(Udp, AStrangerWhoDoesNotSpeakTheProtocolIsNeverTheProbe) {
  const auto source =
      open_udp({.shows_sender = [](std::span<const std::uint8_t> datagram) { return datagram[0] == 1; }});
  EXPECT_THAT(source->name(), testing::StartsWith("udp:127.0.0.1:"));
  const Sender stranger;
  const Sender probe;
  stranger.send(port_of(*source), {66});
  probe.send(port_of(*source), {1, 5});
  stranger.send(port_of(*source), {1, 66});
  probe.send(port_of(*source), {2});
  EXPECT_EQ(read_once(*source), Bytes({1, 5}));
  EXPECT_EQ(read_once(*source), Bytes({2}));
  EXPECT_TRUE(source->write(Bytes{3}));
  EXPECT_EQ(probe.receive(), Bytes({3}));
}

// A probe whose frames come in pieces shows itself by several datagrams, whoever else sends between them.
TEST(Udp, ASenderShowsItselfByAllThatItHasSent) {
  const Bytes word = {1, 2, 3};
  const auto source = open_udp(
      {.shows_sender = [&word](std::span<const std::uint8_t> bytes) { return std::ranges::equal(bytes, word); }});
  const Sender stranger;
  const Sender probe;
  probe.send(port_of(*source), {1});
  stranger.send(port_of(*source), {2});
  probe.send(port_of(*source), {2});
  stranger.send(port_of(*source), {3});
  probe.send(port_of(*source), {3});
  stranger.send(port_of(*source), {1, 2, 3});
  probe.send(port_of(*source), {4});
  EXPECT_EQ(read_once(*source), Bytes({3}));
  EXPECT_EQ(read_once(*source), Bytes({4}));
}

TEST(Udp, KeepsLittleOfStrangers) {
  std::size_t most = 0;
  const auto source = open_udp({.shows_sender = [&most](std::span<const std::uint8_t> bytes) {
    most = std::max(most, bytes.size());
    return bytes.back() == 1;
  }});
  std::deque<Sender> strangers(20);
  Bytes buffer(10);
  for (int round = 0; round < 4; ++round) {
    for (const Sender& stranger : strangers) {
      stranger.send(port_of(*source), Bytes(4000, 7));
      EXPECT_EQ(source->read(buffer, 1ms).count, 0u);
    }
  }
  // Of eight senders at a time the newest are remembered; these had all been forgotten before they came again.
  EXPECT_EQ(most, 4000u);
  for (int round = 0; round < 4; ++round) {
    strangers[0].send(port_of(*source), Bytes(4000, 7));
    EXPECT_EQ(source->read(buffer, 1ms).count, 0u);
  }
  EXPECT_GT(most, 4096u);
  EXPECT_LE(most, 4096u + 4000u);
  strangers[0].send(port_of(*source), {1});
  EXPECT_EQ(read_once(*source), Bytes({1}));
}

TEST(Udp, AfterASilenceTheProbeMayComeFromAnotherPort) {
  const auto source = open_udp({.address = "127.0.0.1", .silence_s = 0.0});
  const Sender before;
  const Sender after;
  before.send(port_of(*source), {1});
  EXPECT_EQ(read_once(*source), Bytes({1}));
  after.send(port_of(*source), {2});
  EXPECT_EQ(read_once(*source), Bytes({2}));
  EXPECT_TRUE(source->write(Bytes{3}));
  EXPECT_EQ(after.receive(), Bytes({3}));
}

TEST(Udp, AnAnswerThatNobodyHearsIsNoError) {
  const auto source = open_udp({.address = "127.0.0.1"});
  {
    const Sender gone;
    gone.send(port_of(*source), {1});
    EXPECT_EQ(read_once(*source), Bytes({1}));
  }
  for (int i = 0; i < 3; ++i) {
    source->write(Bytes{1});
    Bytes buffer(10);
    EXPECT_EQ(source->read(buffer, 2ms).count, 0u);
  }
}

TEST(Udp, WhatCannotBeBoundIsRefused) {
  const auto source = open_udp({.address = "127.0.0.1"});
  const auto port = static_cast<std::uint16_t>(port_of(*source));
  EXPECT_THAT([&] { open_udp({.address = "127.0.0.1", .port = port}); },
              ThrowsMessage<Error>(HasSubstr(source->name() + ": is in use")));
  EXPECT_THAT([] { open_udp({.address = "nonsense"}); }, ThrowsMessage<Error>(HasSubstr("not an IP address")));
  EXPECT_THAT([] { open_udp({.address = "203.0.113.77"}); }, ThrowsMessage<Error>(HasSubstr("cannot be bound")));
}

}  // namespace
}  // namespace asperity
