#include "asperity_firmware/probe.h"

#include <gmock/gmock.h>
#include <memory>
#include <nlohmann/json.hpp>

#include "probe_rig.h"

namespace asperity {
namespace {

using reference::Decoded;
using reference::SampleFrame;

void expect_every_sample(double imu_rate_Hz, double force_rate_Hz, bool gyro, bool force3, std::uint64_t step_us) {
  SCOPED_TRACE(testing::Message() << imu_rate_Hz << " Hz, force " << force_rate_Hz << " Hz, gyro " << gyro
                                  << ", force3 " << force3 << ", a step each " << step_us << " us");
  FakeBoard::Options options;
  options.imu_rate_Hz = imu_rate_Hz;
  options.force_rate_Hz = force_rate_Hz;
  options.link_buffer = 4096;
  options.link_bytes_per_s = 200000.0;
  ProbeRig rig(options, gyro, force3);
  rig.run_us(3'000'000, step_us);
  const Decoded decoded = rig.decoded();
  EXPECT_EQ(decoded.damaged, 0);
  const Account account = check_samples(rig, decoded.samples);
  EXPECT_EQ(account.rows_missing, 0u);
  EXPECT_EQ(account.forces_missing, 0u);
  EXPECT_EQ(account.overruns, 0);
  // What is not there yet is younger than the latency, one step and what the link still holds, 25 ms.
  const double late_s = 0.010 + 2e-6 * static_cast<double>(step_us) + 0.025;
  EXPECT_LE(static_cast<double>(rig.board.rows_made() - account.rows), late_s * imu_rate_Hz + 1.0);
  EXPECT_LE(static_cast<double>(rig.board.forces_made() - account.forces), late_s * force_rate_Hz + 1.0);
}

TEST(FirmwareProbe, SendsEverySampleAtAnyRates) {
  for (const double imu_rate_Hz : {0.0, 100.0, 1000.0, 4000.0}) {
    for (const double force_rate_Hz : {0.0, 80.0, 333.3, 1000.0, 2000.0}) {
      for (const bool gyro : {false, true}) {
        for (const bool force3 : {false, true}) {
          for (const std::uint64_t step_us : {137u, 1000u, 7000u}) {
            expect_every_sample(imu_rate_Hz, force_rate_Hz, gyro, force3, step_us);
            if (HasFailure()) return;
          }
        }
      }
    }
  }
}

TEST(FirmwareProbe, CountersWrap) {
  FakeBoard::Options options;
  ProbeRig rig(options, true, true);
  const std::uint32_t near_the_end = 0xFFFFFF00u;
  rig.probe->sequence = near_the_end;
  rig.probe->next_index = near_the_end;
  rig.probe->expected_index = near_the_end;
  rig.probe->rows_put = rig.probe->rows_taken = near_the_end;
  rig.probe->forces_put = rig.probe->forces_taken = near_the_end;
  rig.run_us(2'000'000, 500);
  const Decoded decoded = rig.decoded();
  EXPECT_LT(decoded.samples.back().sequence, 1000u);
  EXPECT_LT(decoded.samples.back().imu_index, 10000u);
  const Account account = check_samples(rig, decoded.samples, near_the_end, near_the_end);
  EXPECT_EQ(account.rows_missing, 0u);
  EXPECT_EQ(account.overruns, 0);
}

TEST(FirmwareProbe, ClockMayStartAnywhere) {
  for (const std::uint64_t start_us : {std::uint64_t{0}, (std::uint64_t{1} << 32) - 500'000}) {
    FakeBoard::Options options;
    options.start_us = start_us;
    ProbeRig rig(options, true, false);
    rig.run_us(1'000'000, 500);
    const Account account = check_samples(rig, rig.decoded().samples);
    EXPECT_EQ(account.rows_missing, 0u);
    EXPECT_GT(account.rows, 3900u);
  }
}

TEST(FirmwareProbe, KeepsJitterOutOfTheFrames) {
  FakeBoard::Options options;
  options.row_jitter_us = 12.0;  // of a period of 250 µs: two spacings differ by less than a quarter
  ProbeRig rig(options, true, false);
  rig.run_us(1'000'000, 500);
  const Decoded decoded = rig.decoded();
  const Account account = check_samples(rig, decoded.samples, 0, 0, 25.1e3);
  EXPECT_EQ(account.rows_missing, 0u);
  EXPECT_LT(decoded.samples.size(), 4000u / 16u + 10u);
}

TEST(FirmwareProbe, DescribesItselfAtTheStartAndEverySecond) {
  FakeBoard::Options options;
  ProbeRig rig(options, true, false);
  rig.run_us(10'500'000, 1000);
  const Decoded decoded = rig.decoded();
  EXPECT_EQ(decoded.order.front(), 'd');
  EXPECT_EQ(decoded.descriptions.size(), 11u);
  EXPECT_EQ(nlohmann::json::parse(decoded.descriptions.back())["name"], "test probe");
  EXPECT_EQ(rig.board.received().front(), 0);
}

TEST(FirmwareProbe, DescribesItselfInTimeOnALinkThatIsTooSlow) {
  FakeBoard::Options options;
  options.link_bytes_per_s = 20000.0;
  ProbeRig rig(options, true, false);
  rig.run_us(10'000'000, 1000);
  EXPECT_GE(rig.decoded().descriptions.size(), 9u);
}

TEST(FirmwareProbe, AnswersTheHostButNotWithoutEnd) {
  FakeBoard::Options options;
  ProbeRig rig(options, true, false);
  rig.run_us(300'000, 1000);
  ASSERT_EQ(rig.decoded().descriptions.size(), 1u);
  const std::vector<std::uint8_t> request = reference::frame_of(std::vector<std::uint8_t>{0x01, 0x81});
  rig.board.send_from_host(request);
  rig.run_us(20'000, 1000);
  EXPECT_EQ(rig.decoded().descriptions.size(), 2u);
  for (int i = 0; i < 1000; ++i) {
    rig.board.send_from_host(request);
    rig.run_us(1000, 1000);
  }
  EXPECT_LE(rig.decoded().descriptions.size(), 13u);
  const Account account = check_samples(rig, rig.decoded().samples);
  EXPECT_EQ(account.rows_missing, 0u);
}

TEST(FirmwareProbe, WritesDatagramsOfWholeFrames) {
  FakeBoard::Options options;
  options.datagrams = true;
  options.link_buffer = 1500;
  ProbeRig rig(options, true, false);
  rig.run_us(1'000'000, 1000);
  std::size_t at = 0;
  for (const std::size_t size : rig.board.writes()) {
    at += size;
    if (at > rig.board.received().size()) break;
    ASSERT_EQ(rig.board.received()[at - 1], 0);
  }
  EXPECT_GT(rig.board.writes().size(), 200u);
  EXPECT_EQ(check_samples(rig, rig.decoded().samples).rows_missing, 0u);
}

TEST(FirmwareProbe, FillsTheLargestFrame) {
  FakeBoard::Options options;
  options.link_bytes_per_s = 400000.0;
  options.link_buffer = 4096;
  options.force_rate_Hz = 2000.0;
  asp_probe_config config = asp_default_config;
  config.rows_per_frame = 64;
  config.latency_us = 100000;
  ProbeRig rig(options, true, true, config);
  rig.run_us(1'000'000, 30'000);
  const Decoded decoded = rig.decoded();
  std::size_t largest = 0;
  for (const SampleFrame& frame : decoded.samples) largest = std::max(largest, frame.rows.size() + frame.forces.size());
  EXPECT_EQ(largest, 80u);
  EXPECT_EQ(check_samples(rig, decoded.samples).rows_missing, 0u);
}

TEST(FirmwareProbe, SendsForcesFarFromTheRowsInFramesOfTheirOwn) {
  struct Board {
    std::uint64_t now_us = std::uint64_t{1} << 40;
    int rows = 20;
    int forces = 3;
    std::vector<std::uint8_t> sent;
  } state;
  const asp_board board = {&state,
                           [](void* context) { return static_cast<Board*>(context)->now_us; },
                           [](void* context, asp_imu_row* rows, std::size_t) {
                             auto& self = *static_cast<Board*>(context);
                             if (self.rows == 0) return std::size_t{0};
                             --self.rows;
                             rows[0] = {};
                             rows[0].time_ns = self.now_us * 1000 - static_cast<std::uint64_t>(self.rows) * 250'000;
                             return std::size_t{1};
                           },
                           [](void* context, asp_force_sample* sample) {
                             auto& self = *static_cast<Board*>(context);
                             *sample = {};
                             sample->time_us = 1000;  // an hour and more before the rows
                             return self.forces-- > 0;
                           },
                           [](void* context, const std::uint8_t* bytes, std::size_t count) {
                             auto& sent = static_cast<Board*>(context)->sent;
                             sent.insert(sent.end(), bytes, bytes + count);
                             return count;
                           },
                           nullptr,
                           nullptr};
  auto probe = std::make_unique<asp_probe>();
  const asp_description description = description_of(true, false);
  ASSERT_TRUE(asp_probe_init(probe.get(), &board, &description, nullptr));
  for (int i = 0; i < 100; ++i) {
    asp_probe_step(probe.get());
    state.now_us += 1000;
  }
  int rows = 0;
  std::vector<std::uint64_t> force_times;
  for (const SampleFrame& frame : reference::decode(state.sent).samples) {
    rows += static_cast<int>(frame.rows.size());
    for (const auto& force : frame.forces)
      force_times.push_back(frame.time_us + static_cast<std::uint64_t>(force.offset_us));
  }
  EXPECT_EQ(rows, 20);
  EXPECT_EQ(force_times, std::vector<std::uint64_t>(3, 1000));
}

TEST(FirmwareProbe, RefusesAConfigurationOutOfRange) {
  FakeBoard board{FakeBoard::Options{}};
  auto probe = std::make_unique<asp_probe>();
  const asp_description description = description_of(true, false);
  const auto accepts = [&](auto change) {
    asp_probe_config config = asp_default_config;
    change(config);
    return asp_probe_init(probe.get(), board.board(), &description, &config);
  };
  EXPECT_TRUE(accepts([](auto&) {}));
  EXPECT_FALSE(accepts([](auto& c) { c.rows_per_frame = 0; }));
  EXPECT_FALSE(accepts([](auto& c) { c.rows_per_frame = 65; }));
  EXPECT_FALSE(accepts([](auto& c) { c.description_period_us = 2'000'001; }));
  EXPECT_FALSE(accepts([](auto& c) { c.latency_us = 1'000'001; }));
  asp_description bad = description;
  bad.force_axes = 2;
  EXPECT_FALSE(asp_probe_init(probe.get(), board.board(), &bad, nullptr));
}

TEST(FirmwareProbe, RunsForTwoMinutesWithoutALoss) {
  FakeBoard::Options options;
  ProbeRig rig(options, true, false);
  rig.run_us(120'000'000, 1000);
  const Decoded decoded = rig.decoded();
  EXPECT_EQ(decoded.damaged, 0);
  const Account account = check_samples(rig, decoded.samples);
  EXPECT_EQ(account.rows_missing + account.forces_missing, 0u);
  EXPECT_GT(account.rows, 479'900u);
  const double bytes_per_s = static_cast<double>(rig.board.received().size()) / 120.0;
  EXPECT_LT(bytes_per_s, 70e3);  // of the 92 kB/s of 921,600 bps
  RecordProperty("bytes_per_s", static_cast<int>(bytes_per_s));
  RecordProperty("sizeof_asp_probe", static_cast<int>(sizeof(asp_probe)));
}

}  // namespace
}  // namespace asperity
