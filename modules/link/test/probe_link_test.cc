#include "asperity/link/probe_link.h"

#include <gmock/gmock.h>
#include <fstream>

#include "asperity/link/open_protocol.h"
#include "asperity/link/probe_address.h"
#include "asperity/testkit/temp_dir.h"

namespace asperity {
namespace {

using namespace std::chrono_literals;
using Bytes = std::vector<std::uint8_t>;
using testing::HasSubstr;
using testing::ThrowsMessage;

TEST(ProbeAddress, IsReadAsPeopleTypeIt) {
  ProbeAddress address = parse_probe_address("serial:/dev/ttyUSB0@921600");
  EXPECT_EQ(address.kind, ProbeLinkKind::kSerial);
  EXPECT_EQ(address.path, "/dev/ttyUSB0");
  EXPECT_EQ(address.baud, 921600);
  EXPECT_EQ(parse_probe_address("serial:/dev/pts/3").baud, 0);

  address = parse_probe_address("usb:10c4:EA60");
  EXPECT_EQ(address.kind, ProbeLinkKind::kUsb);
  EXPECT_EQ(address.vendor, 0x10c4);
  EXPECT_EQ(address.product, 0xea60);
  EXPECT_EQ(address.serial_number, "");
  address = parse_probe_address("usb:403:6001:A:9@115200");
  EXPECT_EQ(address.vendor, 0x403);
  EXPECT_EQ(address.serial_number, "A:9");
  EXPECT_EQ(address.baud, 115200);

  address = parse_probe_address("udp:9000");
  EXPECT_EQ(address.kind, ProbeLinkKind::kUdp);
  EXPECT_EQ(address.address, "127.0.0.1");
  EXPECT_EQ(address.port, 9000);
  EXPECT_EQ(parse_probe_address("udp:127.0.0.1:9001").address, "127.0.0.1");
  EXPECT_EQ(parse_probe_address("udp:[::1]:9001").address, "::1");

  address = parse_probe_address("file:a b:c.bin@2250");
  EXPECT_EQ(address.kind, ProbeLinkKind::kFile);
  EXPECT_EQ(address.path, "a b:c.bin");
  EXPECT_EQ(address.bytes_per_s, 2250.0);
  EXPECT_EQ(parse_probe_address("file:/c.bin").bytes_per_s, 0.0);
}

TEST(ProbeAddress, WhatIsNoneIsRefusedWithWhatIsAllowed) {
  for (const char* text : {"",
                           "/dev/ttyUSB0",
                           "serial:",
                           "serial:@9600",
                           "serial:/dev/x@",
                           "serial:/dev/x@fast",
                           "serial:/dev/x@-1",
                           "usb:",
                           "usb:10c4",
                           "usb:10c4:",
                           "usb:10c4:ea60:",
                           "usb:10c4x:ea60",
                           "usb:12345:1",
                           "usb:0x10:1",
                           "udp:",
                           "udp:0",
                           "udp:65536",
                           "udp::9000",
                           "udp:host:",
                           "file:",
                           "file:x@0",
                           "file:x@nan",
                           "file:x@1e300",
                           "tcp:1",
                           "SERIAL:/dev/x"}) {
    EXPECT_THAT([&] { parse_probe_address(text); }, ThrowsMessage<Error>(HasSubstr("udp:[ADDRESS:]PORT"))) << text;
  }
  EXPECT_THAT([] { parse_probe_address("\x1b[2Jx:1"); }, ThrowsMessage<Error>(HasSubstr("\\x1b")));
  EXPECT_THROW(parse_probe_address(std::string_view("file:a\0b", 8)), Error);
}

TEST(ProbeAddress, OpensAFile) {
  const testkit::TempDir dir;
  const std::string path = (dir / "c.bin").string();
  Bytes bytes;
  OpenSamples frame;
  frame.row_count = 4;
  frame.imu_period_ns = 250'000;
  for (std::uint32_t i = 0; i < 100; ++i) {
    frame.sequence = i;
    frame.imu_index = 4 * i;
    frame.time_us = 1'000'000 + 1000 * i;
    append_open_samples(frame, bytes);
  }
  std::ofstream(path, std::ios::binary)
      .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  const std::string rate = std::to_string(bytes.size() * 10);
  std::vector<ProbeSample> first;
  for (int run = 0; run < 2; ++run) {
    ProbeLink link(open_probe_source(parse_probe_address("file:" + path + "@" + rate), ProbeProtocol::kOpen),
                   ProbeProtocol::kOpen);
    std::vector<ProbeSample> samples;
    EXPECT_THROW(while (true) link.read(samples, 1s), LinkLost);
    EXPECT_EQ(link.statistics().frames, 100u);
    EXPECT_EQ(samples.size(), 400u);
    if (run == 0) first = samples;
    for (std::size_t i = 0; i < samples.size(); ++i) ASSERT_EQ(samples[i].t_ns, first[i].t_ns);
  }
  EXPECT_THAT([&] { open_probe_source(parse_probe_address("serial:" + path), ProbeProtocol::kWhat); },
              ThrowsMessage<Error>(HasSubstr("not a serial port")));
}

// A probe that never speaks unless asked.
class SilentSource : public ByteSource {
 public:
  explicit SilentSource(std::vector<Bytes>* written) : written_(written) {}
  Arrival read(std::span<std::uint8_t> into, std::chrono::milliseconds) override {
    if (written_->empty()) return {};
    Bytes answer;
    append_open_description(R"({"model":"open","name":"asked"})", answer);
    std::copy(answer.begin(), answer.end(), into.begin());
    return {answer.size(), 1};
  }
  bool write(std::span<const std::uint8_t> bytes) override {
    written_->emplace_back(bytes.begin(), bytes.end());
    return true;
  }
  std::string name() const override { return "silent"; }

 private:
  std::vector<Bytes>* written_;
};

TEST(ProbeLink, AsksAnOpenProbeForItsDescription) {
  std::vector<Bytes> written;
  const auto begin = std::chrono::steady_clock::now();
  ProbeLink link(std::make_unique<SilentSource>(&written), ProbeProtocol::kOpen);
  EXPECT_FALSE(link.description().has_value());
  std::vector<ProbeSample> samples;
  while (!link.description() && std::chrono::steady_clock::now() - begin < 30s) link.read(samples, 1ms);
  ASSERT_TRUE(link.description().has_value());
  EXPECT_EQ(link.description()->name, "asked");
  EXPECT_GE(std::chrono::steady_clock::now() - begin, 1s);
  EXPECT_THAT(written, testing::ElementsAre(Bytes({0, 7, 1, 0x81, 8, 0x90, 0x7d, 0xc2, 0})));
  EXPECT_EQ(link.name(), "silent");
}

TEST(ProbeLink, TheSeedsProbeIsKnownAndNeverAsked) {
  std::vector<Bytes> written;
  const ProbeLink link(std::make_unique<SilentSource>(&written), ProbeProtocol::kWhat);
  ASSERT_TRUE(link.description().has_value());
  EXPECT_EQ(link.description()->model, "what");
  EXPECT_EQ(link.description()->adc_max, 255.0);
}

}  // namespace
}  // namespace asperity
