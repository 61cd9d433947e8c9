// Faults of the sensors on the way to the host: when they are sent, and as which bytes.

#include <gmock/gmock.h>
#include <vector>

#include "asperity/link/probe_decoder.h"
#include "asperity_firmware/probe.h"
#include "reference_decoder.h"

namespace asperity {
namespace {

using Bytes = std::vector<std::uint8_t>;

// A probe whose sensors give nothing but their state.
class Faulty {
 public:
  Faulty() {
    const asp_description description = {"p", "1", 4000, -32768, 32767, 200.0, true, 900.0, 1, 1000, 1e-6};
    EXPECT_TRUE(asp_probe_init(&*probe_, &board_, &description, nullptr));
  }
  Faulty(const Faulty&) = delete;
  Faulty& operator=(const Faulty&) = delete;

  void run_ms(int ms) {
    for (int i = 0; i < ms; ++i) {
      now_us_ += 1000;
      asp_probe_step(probe_.get());
    }
  }

  // Payloads of type 03h since the last call.
  std::vector<Bytes> take_faults() {
    std::vector<Bytes> out;
    Bytes block;
    for (const std::uint8_t byte : written) {
      if (byte != 0) {
        block.push_back(byte);
        continue;
      }
      const auto payload = reference::payload_of(block);
      if (payload && payload->at(1) == 3) out.push_back(*payload);
      block.clear();
    }
    written.clear();
    return out;
  }

  asp_faults faults{};
  Bytes written;

 private:
  static Faulty& of(void* context) { return *static_cast<Faulty*>(context); }
  std::uint64_t now_us_ = 5'000'000;
  std::unique_ptr<asp_probe> probe_ = std::make_unique<asp_probe>();
  asp_board board_ = {this,
                      [](void* context) { return of(context).now_us_; },
                      [](void*, asp_imu_row*, std::size_t) { return std::size_t{0}; },
                      nullptr,
                      [](void* context, const std::uint8_t* bytes, std::size_t count) {
                        of(context).written.insert(of(context).written.end(), bytes, bytes + count);
                        return count;
                      },
                      nullptr,
                      [](void* context, asp_faults* out) { *out = of(context).faults; }};
};

TEST(FirmwareFaults, AreNotSentWhereThereAreNone) {
  Faulty probe;
  probe.run_ms(5000);
  EXPECT_THAT(probe.take_faults(), testing::IsEmpty());
}

TEST(FirmwareFaults, TheVectorOfTheDocument) {
  Faulty probe;
  probe.run_ms(50);
  probe.written.clear();
  probe.faults = {ASP_SENSOR_NOT_FOUND, ASP_SENSOR_WORKS, {3, 1, 0, 0, 2, 0, 258, 0}};
  probe.run_ms(100);
  EXPECT_EQ(probe.written, (Bytes{0x04, 0x01, 0x03, 0x02, 0x02, 0x03, 0x01, 0x01, 0x02, 0x01, 0x01, 0x01, 0x01, 0x01,
                                  0x01, 0x01, 0x01, 0x01, 0x01, 0x01, 0x02, 0x02, 0x01, 0x01, 0x01, 0x01, 0x01, 0x01,
                                  0x03, 0x02, 0x01, 0x01, 0x01, 0x01, 0x01, 0x01, 0x05, 0x3d, 0x26, 0x49, 0x96, 0x00}));
  EXPECT_EQ(probe.take_faults().size(), 1u);
}

TEST(FirmwareFaults, AreRepeatedEachSecondAndAtMostTenTimesASecond) {
  Faulty probe;
  probe.faults.imu_state = ASP_SENSOR_BUS_FAILS;
  probe.run_ms(5050);
  EXPECT_THAT(probe.take_faults().size(), testing::AllOf(testing::Ge(5u), testing::Le(6u)));
  for (int i = 0; i < 1000; ++i) {
    ++probe.faults.counts[ASP_FAULTS_IMU_BUS_FAILURES];
    probe.run_ms(1);
  }
  EXPECT_THAT(probe.take_faults().size(), testing::AllOf(testing::Ge(9u), testing::Le(11u)));
}

TEST(FirmwareFaults, ThatAllIsWellAgainIsSentOnce) {
  Faulty probe;
  probe.faults.force_state = ASP_SENSOR_NOT_AS_WRITTEN;
  probe.run_ms(200);
  probe.take_faults();
  probe.faults.force_state = ASP_SENSOR_WORKS;
  probe.run_ms(5000);
  const auto sent = probe.take_faults();
  ASSERT_EQ(sent.size(), 1u);
  EXPECT_EQ(sent[0].at(3), 0);
}

TEST(FirmwareFaults, TheHostReadsEachFieldAtItsPlace) {
  Faulty probe;
  probe.faults = {4, 1, {0x01020304, 2, 3, 4, 5, 6, 7, 0xFFFFFFFF}};
  probe.run_ms(5);
  const auto decoder = make_probe_decoder(ProbeProtocol::kOpen);
  std::vector<ProbeSample> samples;
  decoder->push(probe.written, 1'000'000, samples);
  const ProbeFaults expected{4, 1, 0x01020304, 2, 3, 4, 5, 6, 7, 0xFFFFFFFF};
  EXPECT_EQ(decoder->statistics().faults, expected);
  EXPECT_EQ(describe_faults(expected),
            "inertial sensor: a register does not keep its value, 16909060 bus failures, 2 overflows, 3 reads out of "
            "step, 4 invalid rows, 5 restarts; force sensor: its bus fails, 6 bus failures, 7 conversions skipped, "
            "4294967295 restarts");
}

}  // namespace
}  // namespace asperity
