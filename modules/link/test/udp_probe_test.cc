// A probe over UDP: who is taken for it.
#include <gmock/gmock.h>

#include <memory>
#include <vector>

#include "asperity/link/open_protocol.h"
#include "asperity/link/probe_address.h"
#include "asperity/link/probe_link.h"
#include "asperity/testkit/udp_sender.h"

namespace asperity {
namespace {

using namespace std::chrono_literals;
using Bytes = std::vector<std::uint8_t>;
using testkit::UdpSender;

constexpr auto kLong = 20s;

std::unique_ptr<ByteSource> udp_source(ProbeProtocol protocol) {
  ProbeAddress address;
  address.kind = ProbeLinkKind::kUdp;
  return open_probe_source(address, protocol);
}

Bytes open_frame(std::uint32_t sequence) {
  OpenSamples frame;
  frame.row_count = 4;
  frame.imu_period_ns = 250'000;
  frame.sequence = sequence;
  frame.imu_index = 4 * sequence;
  frame.time_us = 1'000'000 + 1000 * sequence;
  Bytes out;
  append_open_samples(frame, out);
  return out;
}

Bytes read_once(ByteSource& source) {
  Bytes out(2000);
  out.resize(source.read(out, kLong).count);
  return out;
}

TEST(UdpProbe, HearsThisMachineAloneUnlessTold) {
  EXPECT_EQ(parse_probe_address("udp:9000").address, "127.0.0.1");
  EXPECT_THAT(udp_source(ProbeProtocol::kOpen)->name(), testing::StartsWith("udp:127.0.0.1:"));
  EXPECT_EQ(parse_probe_address("udp:0.0.0.0:9000").address, "0.0.0.0");
}

TEST(UdpProbe, IsTheFirstWhoSendsAWholeFrame) {
  const auto source = udp_source(ProbeProtocol::kOpen);
  const int port = testkit::port_in(source->name());
  const UdpSender stranger;
  const UdpSender probe;
  Bytes damaged = open_frame(7);
  damaged[damaged.size() / 2] ^= 1U;
  stranger.send(port, Bytes{1, 2, 3});
  stranger.send(port, damaged);
  stranger.send_text(port, "GET / HTTP/1.1\r\n\r\n");
  probe.send(port, open_frame(0));
  stranger.send(port, open_frame(99));
  probe.send(port, open_frame(1));
  EXPECT_EQ(read_once(*source), open_frame(0));
  EXPECT_EQ(read_once(*source), open_frame(1));
  EXPECT_TRUE(source->write(Bytes{5}));
  EXPECT_EQ(probe.receive(), Bytes{5});
}

TEST(UdpProbe, ADescriptionShowsItToo) {
  const auto source = udp_source(ProbeProtocol::kOpen);
  const UdpSender probe;
  Bytes description;
  append_open_description(R"({"model":"open","name":"described"})", description);
  probe.send(testkit::port_in(source->name()), description);
  EXPECT_EQ(read_once(*source), description);
}

// A bridge from a serial line sends few bytes at a time; a frame of `what` is found by those behind it.
TEST(UdpProbe, AWhatProbeMaySendAFrameADatagram) {
  const auto source = udp_source(ProbeProtocol::kWhat);
  const int port = testkit::port_in(source->name());
  const UdpSender stranger;
  const UdpSender probe;
  for (std::uint8_t i = 0; i < 20; ++i) {
    stranger.send(port, Bytes{i, i, i, i, i});
    probe.send(port, Bytes{0xFF, 100, static_cast<std::uint8_t>(101 + i), 102, 30});
  }
  const Bytes first = read_once(*source);
  ASSERT_EQ(first.size(), 5u);
  EXPECT_EQ(first[0], 0xFF);
  EXPECT_LE(first[2], 101 + 6);
  for (int next = first[2] + 1; next < 121; ++next) EXPECT_EQ(read_once(*source)[2], next);
}

}  // namespace
}  // namespace asperity
