// What is dropped is counted, on a link that is too slow and by a sensor that was read too late.

#include <gmock/gmock.h>
#include <memory>

#include "probe_rig.h"

namespace asperity {
namespace {

using reference::Decoded;

TEST(FirmwareOverrun, CountsExactlyWhatASlowLinkCosts) {
  FakeBoard::Options options;
  options.link_bytes_per_s = 30000.0;  // about half of what the samples need
  ProbeRig rig(options, true, false);
  rig.run_us(5'000'000, 500);
  rig.board.set_link_speed(1e6);
  rig.run_us(1'000'000, 500);
  const Account account = check_samples(rig, rig.decoded().samples);
  EXPECT_GT(account.rows_missing, 5000u);
  EXPECT_EQ(account.rows_missing, rig.probe->statistics.rows_dropped);
  EXPECT_EQ(account.forces_missing, rig.probe->statistics.forces_dropped);
  EXPECT_LE(rig.board.rows_made() - account.next_row, 60u);
  EXPECT_GT(account.overruns, 100);
}

TEST(FirmwareOverrun, ToldOfDroppedForceSamples) {
  FakeBoard::Options options;
  options.imu_rate_Hz = 0.0;
  options.link_bytes_per_s = 0.0;
  ProbeRig rig(options, true, false);
  rig.run_us(500'000, 1000);
  rig.board.set_link_speed(1e6);
  rig.run_us(500'000, 1000);
  const Decoded decoded = rig.decoded();
  const Account account = check_samples(rig, decoded.samples);
  EXPECT_GT(account.forces_missing, 100u);
  EXPECT_EQ(account.forces_missing, rig.probe->statistics.forces_dropped);
  EXPECT_GE(account.overruns, 1);
}

TEST(FirmwareOverrun, LosesNothingWhileTheLinkStallsFor50Milliseconds) {
  FakeBoard::Options options;
  options.link_bytes_per_s = 115200.0;
  ProbeRig rig(options, true, false);
  for (int i = 0; i < 10; ++i) {
    rig.run_us(450'000, 500);
    rig.board.set_link_speed(0.0);
    rig.run_us(50'000, 500);
    rig.board.set_link_speed(115200.0);
  }
  rig.run_us(450'000, 500);
  const Account account = check_samples(rig, rig.decoded().samples);
  EXPECT_EQ(account.rows_missing, 0u);
  EXPECT_EQ(account.overruns, 0);
  EXPECT_GT(account.rows, 19000u);
}

TEST(FirmwareOverrun, CountsWhatTheSensorLost) {
  FakeBoard::Options options;
  ProbeRig rig(options, true, false);
  for (const std::uint32_t lost : {1u, 7u, 1u, 300u, 2u}) {
    rig.run_us(200'000, 500);
    rig.board.make_sensor_lose(lost);
  }
  rig.run_us(400'000, 500);
  const Account account = check_samples(rig, rig.decoded().samples);
  EXPECT_EQ(account.rows_missing, 311u);
  EXPECT_EQ(account.overruns, 5);
  EXPECT_EQ(rig.probe->statistics.rows_dropped, 311u);
}

TEST(FirmwareOverrun, CountsWhatAFullFifoCost) {
  FakeBoard::Options options;
  ProbeRig rig(options, true, false);
  for (int i = 0; i < 5; ++i) {
    rig.run_us(200'000, 500);
    rig.run_us(100'000, 100'000);  // the loop was held up
  }
  rig.run_us(300'000, 500);
  const Account account = check_samples(rig, rig.decoded().samples);
  EXPECT_GT(account.rows_missing, 1000u);
  EXPECT_EQ(account.rows_missing, rig.board.fifo_lost());
  EXPECT_EQ(account.needless_overruns, 0);
}

}  // namespace
}  // namespace asperity
