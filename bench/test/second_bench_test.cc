#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include <gtest/gtest.h>

#include "../second_bench/second_scan.h"
#include "asperity/geometry/pose.h"
#include "asperity/recording/read_recording.h"

namespace {

using Eigen::Vector3d;
namespace fs = std::filesystem;

class SecondBench : public testing::Test {
 protected:
  void SetUp() override { fs::remove_all(folder_); }
  void TearDown() override { fs::remove_all(folder_); }
  fs::path folder_ = fs::temp_directory_path() /
                     ("second_bench_" + std::string(testing::UnitTest::GetInstance()->current_test_info()->name()));
};

std::string content(const fs::path& path) {
  std::ostringstream out;
  out << std::ifstream(path, std::ios::binary).rdbuf();
  return out.str();
}

TEST_F(SecondBench, TheSameSeedGivesTheSameBytes) {
  const second_bench::ScanPlan plan = second_bench::draw_plan(7, "field", "open");
  second_bench::write_scan(plan, folder_ / "a");
  second_bench::write_scan(plan, folder_ / "b");
  for (const char* name : {"recording.json", "calibration.json", "probe.csv", "tracker.csv", "truth.csv"}) {
    EXPECT_EQ(content(folder_ / "a" / name), content(folder_ / "b" / name)) << name;
    EXPECT_FALSE(content(folder_ / "a" / name).empty()) << name;
  }
}

TEST_F(SecondBench, EveryFamilyIsAWholeRecording) {
  for (const std::string& family : second_bench::families()) {
    for (const char* probe : {"open", "what"}) {
      const fs::path folder = folder_ / (family + probe);
      second_bench::write_scan(second_bench::draw_plan(3, family, probe), folder);
      const asperity::Recording recording = asperity::read_recording(folder);
      EXPECT_TRUE(recording.problems.empty()) << family << ": " << recording.problems.front().message;
      ASSERT_TRUE(recording.truth);
      EXPECT_GE(recording.truth->size(), recording.probe.size());
      EXPECT_EQ(recording.probe.has_gyro(), std::string(probe) == "open");
    }
  }
}

// The mean specific force over 0.1 s is the change of the sensor's velocity over it, less gravity, whatever the filters
// and the clock do; the truth's rows give both, by differences of positions.
TEST_F(SecondBench, TheAccelerometerFeelsTheMotionOfTheTruth) {
  second_bench::ScanPlan plan = second_bench::draw_plan(5, "sines", "open");
  plan.accel_scale_error = plan.accel_offset_error_mps2 = plan.tip_error_m = plan.sensor_place_error_m = 0.0;
  plan.accel_flicker_mps2 = plan.accel_drift_mps2 = plan.batch_s = plan.stamp_jitter_s = 0.0;
  plan.lost_chance = plan.spike_chance = plan.gravity_error_rad = 0.0;
  second_bench::write_scan(plan, folder_);
  const asperity::Recording recording = asperity::read_recording(folder_);
  const asperity::Truth& truth = *recording.truth;
  ASSERT_EQ(truth.size(), recording.probe.size());
  const Vector3d lever_m = recording.calibration.accelerometer_in_marker_m() - recording.calibration.tip_in_marker_m;
  const auto sensor_m = [&](std::size_t i) {
    return Vector3d(truth.p_world_tip_m[i] + truth.q_world_marker[i] * lever_m);
  };
  const auto velocity_mps = [&](std::size_t i) {
    // Over 10 ms: a row's place is rounded to a step of 25 µs.
    const std::size_t reach = static_cast<std::size_t>(0.005 * plan.rate_Hz);
    return Vector3d((sensor_m(i + reach) - sensor_m(i - reach)) /
                    (1e-9 * static_cast<double>(truth.t_ns[i + reach] - truth.t_ns[i - reach])));
  };
  const auto window = static_cast<std::size_t>(0.1 * plan.rate_Hz);
  double square = 0.0, count = 0.0;
  for (std::size_t first = window; first + 2 * window < truth.size(); first += window) {
    Vector3d felt = Vector3d::Zero();
    for (std::size_t i = first; i < first + window; ++i) {
      const Vector3d f = recording.calibration.accelerometer.specific_force_mps2(recording.probe.accel_counts[i]);
      felt += (truth.q_world_marker[i] * f + recording.info.gravity_world_mps2) / static_cast<double>(window);
    }
    const double time_s = 1e-9 * static_cast<double>(truth.t_ns[first + window] - truth.t_ns[first]);
    const Vector3d moved = (velocity_mps(first + window) - velocity_mps(first)) / time_s;
    square += (felt - moved).squaredNorm();
    count += 1.0;
  }
  // Rounding to 1/2048 g and white noise average to 1 mm/s²; the velocities' own means over 10 ms leave some of the
  // contact's ringing, 1 mm/s over 0.1 s.
  EXPECT_LT(std::sqrt(square / count), 0.03);
  EXPECT_GT(count, 15.0);
}

TEST_F(SecondBench, ForceAndHeightAreThoseOfTheContact) {
  second_bench::ScanPlan plan = second_bench::draw_plan(9, "glass", "open");
  plan.height_m = 0.0;
  plan.contact = second_bench::Contact::kHuntCrossley;
  plan.contact_stiffness = 4.0 / 3.0 * 1e8 * std::sqrt(plan.tip_radius_m);
  plan.contact_damping = 5.0;
  plan.approach_s = 0.0;
  plan.rest_before_s = 0.5;
  second_bench::write_scan(plan, folder_);
  const asperity::Recording recording = asperity::read_recording(folder_);
  const asperity::Truth& truth = *recording.truth;
  // At rest on glass the ball sinks by Hertz's (F/K)^(2/3).
  for (std::size_t i = 0; 1e-9 * static_cast<double>(truth.t_ns[i] - truth.t_ns[0]) < 0.3; i += 100) {
    const double depth_m = std::pow(truth.force_N[i] / plan.contact_stiffness, 2.0 / 3.0);
    EXPECT_NEAR(truth.height_m[i], -depth_m, 0.02 * depth_m);
  }
}

}  // namespace
