#include "asperity/recording/import_imu_pose.h"

#include <gmock/gmock.h>
#include <cmath>

#include "asperity/base/error.h"
#include "asperity/recording/format_recording.h"
#include "asperity/recording/inspect_recording.h"
#include "asperity/recording/read_recording.h"
#include "asperity/recording/write_recording.h"
#include "asperity/testkit/temp_dir.h"

namespace asperity {
namespace {

const std::filesystem::path kBroad = std::filesystem::path(ASPERITY_TEST_DATA) / "broad_trial10";

ImportConfig seeds_tracker() {
  ImportConfig config;
  config.pose_rate_Hz = 45.0;
  config.pose_noise_m = {0.15e-3, 0.13e-3, 0.54e-3};  // seed Fig. 9
  return config;
}

// 100 s of a body at rest, 1 kHz, whose position counts its rows.
ImportInput counting_input() {
  ImportInput out;
  for (int i = 0; i < 100'000; ++i) {
    out.imu_t_ns.push_back(1'000'000 * std::int64_t{i});
    out.specific_force_mps2.emplace_back(0.0, 0.0, 9.81);
    out.rate_radps.emplace_back(0.1, 0.0, 0.0);
    out.pose_t_ns.push_back(1'000'000 * std::int64_t{i});
    out.T_world_body.push_back({Eigen::Quaterniond::Identity(), Eigen::Vector3d(0.0, 1e-3 * i, 0.0)});
  }
  return out;
}

TEST(Import, RealMotionKeepsGravityUpAndReadsBack) {
  const ImportInput input = read_imu_pose(kBroad / "imu.csv", kBroad / "mocap.csv");
  const Recording recording = import_imu_pose(input, seeds_tracker());
  EXPECT_EQ(recording.probe.size(), 600u);
  EXPECT_EQ(recording.truth->size(), input.pose_t_ns.size());
  EXPECT_NEAR(static_cast<double>(recording.tracker.size()), 45.0 * 600.0 / 285.714, 2.0);
  for (std::size_t i = 0; i < 600; ++i) {
    // Half a count each.
    EXPECT_NEAR((recording.calibration.accelerometer.specific_force_mps2(recording.probe.accel_counts[i]) -
                 input.specific_force_mps2[i])
                    .cwiseAbs()
                    .maxCoeff(),
                0.0, 0.5 / 208.8 + 1e-6);
  }
  const Inspection inspection = inspect_recording(recording);
  ASSERT_TRUE(inspection.quiet.has_value());
  // The accelerometer's own bias, some 0.1 m/s², turns it by 0.6° and lengthens it by 1 %.
  EXPECT_NEAR(inspection.quiet->gravity_mps2, 9.81, 0.15);
  EXPECT_LT(inspection.quiet->gravity_angle_rad, 0.03);
  EXPECT_THAT(inspection.findings, testing::Not(testing::Contains(testing::HasSubstr("force"))));

  const testkit::TempDir dir;
  write_recording(dir.path(), recording);
  const Recording read = read_recording(dir.path());
  EXPECT_EQ(format_tracker_csv(read.tracker), format_tracker_csv(recording.tracker));
  EXPECT_EQ(read.calibration.accelerometer.position_sigma_m, 0.05);
  EXPECT_TRUE(std::isnan(read.truth->s_m[0]));
}

TEST(Import, ThinsToTheNearestRow) {
  ImportConfig config;
  config.pose_rate_Hz = 45.0;
  const Recording recording = import_imu_pose(counting_input(), config);
  ASSERT_EQ(recording.tracker.size(), 4501u);
  for (std::size_t i = 0; i < recording.tracker.size(); ++i) {
    const auto tick = static_cast<std::int64_t>(std::llround(1000.0 * static_cast<double>(i) / 45.0));
    const std::int64_t row = std::min<std::int64_t>(tick, 99'999);
    ASSERT_EQ(recording.tracker.t_ns[i], 1'000'000 * row) << i;
    ASSERT_EQ(recording.tracker.T_world_marker[i].translation_m.y(), 1e-3 * static_cast<double>(row));
  }
}

TEST(Import, NoiseHasTheSizeAskedForAndFollowsTheSeed) {
  ImportConfig config = seeds_tracker();
  config.rotation_noise_rad = {0.001, 0.002, 0.003};
  const ImportInput input = counting_input();
  const Recording recording = import_imu_pose(input, config);
  Eigen::Vector3d square_m2 = Eigen::Vector3d::Zero();
  Eigen::Vector3d square_rad2 = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < recording.tracker.size(); ++i) {
    const auto row = static_cast<std::size_t>(recording.tracker.t_ns[i] / 1'000'000);
    const Pose& pose = recording.tracker.T_world_marker[i];
    square_m2 += (pose.translation_m - input.T_world_body[row].translation_m).cwiseAbs2();
    square_rad2 += log_rotation(pose.rotation).cwiseAbs2();
  }
  const auto count = static_cast<double>(recording.tracker.size());
  for (int i = 0; i < 3; ++i) {  // five standard errors of a deviation from 4500 samples: 5.3 %
    const auto axis = static_cast<std::size_t>(i);
    EXPECT_NEAR(std::sqrt(square_m2[i] / count), config.pose_noise_m[axis], 0.053 * config.pose_noise_m[axis]);
    EXPECT_NEAR(std::sqrt(square_rad2[i] / count), config.rotation_noise_rad[axis],
                0.053 * config.rotation_noise_rad[axis]);
  }
  EXPECT_EQ(format_tracker_csv(recording.tracker), format_tracker_csv(import_imu_pose(input, config).tracker));
  config.seed = 2;
  EXPECT_NE(format_tracker_csv(recording.tracker), format_tracker_csv(import_imu_pose(input, config).tracker));
}

TEST(Import, RowsWithNanAreCounted) {
  ImportInput input;
  parse_pose_csv(
      "t_s,px_m,py_m,pz_m,qw,qx,qy,qz\n0,0,0,0,1,0,0,0\n0.0035,nan,nan,nan,nan,nan,nan,nan\n0.007,0,0,0,1,0,0,0\n",
      "m.csv", input);
  EXPECT_THAT(input.pose_t_ns, testing::ElementsAre(0, 7'000'000));
  ASSERT_EQ(input.problems.size(), 1u);
  EXPECT_EQ(input.problems[0].kind, "missing_pose");
  EXPECT_THAT(input.problems[0].message, testing::StartsWith("m.csv:3:"));
}

TEST(Import, StrongAccelerationSaturatesLikeTheSensor) {
  ImportInput input = counting_input();
  input.specific_force_mps2[5] = {1000.0, -1000.0, 0.0};
  const Recording recording = import_imu_pose(input, {});
  EXPECT_EQ(recording.probe.accel_counts[5], Eigen::Vector3d(32767.0, -32768.0, 0.0));
}

TEST(Import, RefusesNothingToImport) {
  EXPECT_THROW(import_imu_pose({}, {}), Error);
  ImportInput input;
  EXPECT_THAT([&] { parse_imu_csv("t_s,ax_mps2\n", "i.csv", input); },
              testing::ThrowsMessage<Error>(testing::HasSubstr("column 'ay_mps2' is missing")));
}

}  // namespace
}  // namespace asperity
