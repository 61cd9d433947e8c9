#include "asperity/simulation/calibration_motion.h"

#include <gtest/gtest.h>

#include <cmath>

#include "asperity/base/error.h"
#include "asperity/simulation/board_poses.h"
#include "asperity/simulation/force_steps.h"
#include "asperity/simulation/live_bench.h"

namespace asperity {
namespace {

SimulationConfig quiet_config() {
  SimulationConfig config = without_link_faults(make_simulation_config("protoboard", "open"));
  config.step_s = 1e-4;
  config.probe.accel_noise_mps2_per_rtHz = 0.0;
  config.probe.gyro_noise_radps_per_rtHz = 0.0;
  return config;
}

Eigen::Vector3d tip_of(const SimulationConfig& config) { return Eigen::Vector3d(config.probe.tip_in_marker_m.data()); }

TEST(CalibrationMotion, RestReadsGravity) {
  const SimulationConfig config = quiet_config();
  const Pose T{exp_rotation({0.3, -0.2, 0.5}), {0.01, 0.02, 0.3}};
  const Recording recording = simulate_motion(config, static_motion(T, tip_of(config)), 0.5, "rest");
  const Eigen::Vector3d up_mps2 = T.rotation.conjugate() * -Eigen::Vector3d(config.gravity_world_mps2.data());
  ASSERT_GT(recording.probe.size(), 1900U);
  const Eigen::Vector3d f_mps2 =
      recording.calibration.accelerometer.specific_force_mps2(recording.probe.accel_counts[1000]);
  EXPECT_LT((f_mps2 - up_mps2).norm(), 0.005);  // a count is 0.0048 m/s²
  EXPECT_LT((recording.calibration.gyroscope->B.inverse() *
             (recording.probe.gyro_counts[1000] - recording.calibration.gyroscope->C))
                .norm(),
            2e-3);  // a count is 1.1 mrad/s
  EXPECT_NEAR((recording.truth->p_world_tip_m[5] - T * tip_of(config)).norm(), 0.0, 1e-12);
}

TEST(CalibrationMotion, PivotKeepsItsTip) {
  const SimulationConfig config = quiet_config();
  const PivotMotion pivot;
  const Recording recording = simulate_motion(config, pivot_motion(pivot), 5.0, "pivot");
  double widest_rad = 0.0;
  for (std::size_t i = 0; i < recording.truth->size(); ++i) {
    ASSERT_LT((recording.truth->p_world_tip_m[i] - pivot.p_world_tip_m).norm(), 1e-12);
    widest_rad =
        std::max(widest_rad, recording.truth->q_world_marker[i].angularDistance(recording.truth->q_world_marker[0]));
  }
  EXPECT_GT(widest_rad, 0.5);
}

TEST(CalibrationMotion, StaticPosesStandStillAndDiffer) {
  const SimulationConfig config = quiet_config();
  StaticPosesMotion poses;
  poses.poses = 6;
  const MotionFunction motion = static_poses_motion(poses, tip_of(config));
  for (int i = 0; i < poses.poses; ++i) {
    const double start_s = i * (poses.hold_s + poses.move_s);
    const MotionState a = motion(start_s + 0.01), b = motion(start_s + poses.hold_s - 0.01);
    EXPECT_EQ(a.q_world_marker.coeffs(), b.q_world_marker.coeffs());
    EXPECT_EQ(a.p_world_tip_m, b.p_world_tip_m);
    if (i > 0) {
      EXPECT_GT(a.q_world_marker.angularDistance(motion(start_s - poses.move_s - 0.01).q_world_marker), 0.1);
    }
  }
}

TEST(CalibrationMotion, ShakingBeginsAtRest) {
  const SimulationConfig config = quiet_config();
  const ShakeMotion shake;
  const MotionFunction motion = shake_motion(shake, tip_of(config));
  EXPECT_EQ(motion(0.0).p_world_tip_m, motion(shake.rest_s).p_world_tip_m);
  EXPECT_GT((motion(3.0).p_world_tip_m - motion(3.1).p_world_tip_m).norm(), 1e-4);
}

TEST(CalibrationMotion, ForceStepsAreReadBack) {
  SimulationConfig config = quiet_config();
  config.probe.force_noise_N = 0.0;
  const ForceSteps steps;
  const Recording recording =
      simulate_motion(config, force_steps_motion(steps, {}, tip_of(config)), steps.duration_s(), "force");
  const ForceReadings readings = read_force_steps(steps, recording.probe, recording.truth->t_ns.front());
  ASSERT_EQ(readings.counts.size(), steps.force_N.size());
  for (std::size_t i = 0; i < readings.counts.size(); ++i)
    EXPECT_NEAR(recording.calibration.force.force_N(readings.counts[i]), steps.force_N[i], 3e-4);  // a count
  EXPECT_THROW(read_force_steps(steps, recording.probe, recording.truth->t_ns.front() + 60'000'000'000), Error);
}

TEST(CalibrationMotion, RefusesWhatCannotBe) {
  const SimulationConfig config = quiet_config();
  const MotionFunction rest = static_motion({}, tip_of(config));
  EXPECT_THROW(simulate_motion(config, rest, 0.0, "rest"), Error);
  EXPECT_THROW(simulate_motion(config, rest, 1e6, "rest"), Error);
  EXPECT_THROW(simulate_motion(config, rest, std::nan(""), "rest"), Error);
}

TEST(BoardPoses, AreManyAndTheSameForASeed) {
  const SimulatedCameraConfig config;
  const SimulatedBoard board;
  const auto poses = board_poses(config, board, 20, 3);
  ASSERT_EQ(poses.size(), 20U);
  EXPECT_EQ(poses[7].translation_m, board_poses(config, board, 20, 3)[7].translation_m);
  for (const Pose& pose : poses) {
    const double tilt_rad = std::acos((pose.rotation * Eigen::Vector3d::UnitZ()).z());
    EXPECT_GT(tilt_rad, 0.17);
    EXPECT_LT(tilt_rad, 0.71);
  }
}

}  // namespace
}  // namespace asperity
