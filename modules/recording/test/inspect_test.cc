#include "asperity/recording/inspect_recording.h"

#include <gmock/gmock.h>
#include <cmath>

#include "asperity/base/random.h"
#include "asperity/recording/validate_recording.h"

namespace asperity {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr double kCountsPer_mps2 = 200.0;
constexpr double kNoise_counts = 4.0;
constexpr double kPositionNoise_m = 0.2e-3;

// Two seconds at rest, then two of shaking, 1 kHz and 50 Hz; force at 100 Hz.
Recording rest_then_shake() {
  Random random(5);
  Recording out;
  out.info.probe_rate_Hz = 1000.0;
  out.info.tracker_rate_Hz = 50.0;
  out.info.adc_min = -32768.0;
  out.info.adc_max = 32767.0;
  out.calibration.accelerometer.B = kCountsPer_mps2 * Eigen::Matrix3d::Identity();
  out.calibration.force = {0.01, 0.0, 0.01, std::nullopt};
  out.calibration.tip_in_marker_m = {0.0, 0.0, -0.1};
  out.calibration.tracker.sigma_position_m.setConstant(kPositionNoise_m);
  const Eigen::Vector3d up_mps2 = -out.info.gravity_world_mps2;
  for (int i = 0; i < 4000; ++i) {
    const double shake = i < 2000 ? 0.0 : 3.0 * std::sin(0.05 * i);
    const Eigen::Vector3d noise(random.normal(), random.normal(), random.normal());
    out.probe.t_ns.push_back(1'000'000 * std::int64_t{i});
    out.probe.accel_counts.push_back(kCountsPer_mps2 * (up_mps2 + Eigen::Vector3d(shake, 0.0, 0.0)) +
                                     kNoise_counts * noise);
    out.probe.force_counts.push_back(i % 10 == 0 ? 50.0 + i / 100.0 : std::nan(""));
  }
  for (int i = 0; i < 200; ++i) {
    Pose pose;
    pose.translation_m = {i < 100 ? 0.0 : 0.02 * std::sin(0.5 * i), 0.1, 0.5};
    for (double& x : pose.translation_m) x += kPositionNoise_m * random.normal();
    out.tracker.t_ns.push_back(20'000'000 * std::int64_t{i});
    out.tracker.T_world_marker.push_back(pose);
  }
  return out;
}

TEST(Inspect, GoodRecording) {
  const Inspection inspection = inspect_recording(rest_then_shake());
  EXPECT_THAT(inspection.findings, IsEmpty());
  EXPECT_NEAR(inspection.probe.mean_rate_Hz, 1000.0, 1e-9);
  EXPECT_NEAR(inspection.tracker.median_rate_Hz, 50.0, 1e-9);
  EXPECT_EQ(inspection.probe.clock_step_ns, 1'000'000);
  EXPECT_EQ(inspection.probe.gaps, 0u);
  EXPECT_NEAR(inspection.overlap_s, 3.98, 1e-9);
  EXPECT_NEAR(inspection.force_lowest_N, 0.5, 1e-12);
  EXPECT_NEAR(inspection.force_highest_N, 0.899, 1e-12);
  EXPECT_NEAR(inspection.force_rate_Hz, 100.0, 0.5);
  ASSERT_TRUE(inspection.quiet.has_value());
  const QuietInterval& quiet = *inspection.quiet;
  EXPECT_TRUE(quiet.at_rest);
  EXPECT_LE(quiet.start_s + quiet.duration_s, 2.0);
  // Standard errors of a deviation: 2.2 % from 1000 rows, 10 % from 49 steps (their neighbours correlate).
  const double noise_mps2 = kNoise_counts / kCountsPer_mps2;
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(quiet.acceleration_noise_mps2[i], noise_mps2, 0.1 * noise_mps2);
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(quiet.position_noise_m[i], kPositionNoise_m, 0.4 * kPositionNoise_m);
  EXPECT_NEAR(quiet.gravity_mps2, 9.80665, 5.0 * noise_mps2 / std::sqrt(1000.0));
  EXPECT_LT(quiet.gravity_angle_rad, 1e-3);
  EXPECT_NEAR(inspection.channels[0].quiet_noise, kNoise_counts, 0.1 * kNoise_counts);
}

TEST(Inspect, CountsLossesByTheClock) {
  Recording recording = rest_then_shake();
  ProbeStream probe;
  for (std::size_t i = 0; i < recording.probe.size(); ++i) {
    if (i % 20 == 7 || (i >= 3000 && i < 3200)) continue;  // 200 single rows and one gap of 0.2 s
    probe.t_ns.push_back(recording.probe.t_ns[i]);
    probe.accel_counts.push_back(recording.probe.accel_counts[i]);
    probe.force_counts.push_back(recording.probe.force_counts[i]);
  }
  recording.probe = probe;
  const Inspection inspection = inspect_recording(recording);
  EXPECT_EQ(inspection.probe.lost, 4000u - probe.size());
  EXPECT_EQ(inspection.probe.gaps, 191u);  // ten of the single rows lie in the long gap
  EXPECT_NEAR(inspection.probe.longest_gap_s, 0.201, 1e-9);
  EXPECT_THAT(inspection.findings, Contains(HasSubstr("lost about 390 rows")));
  EXPECT_THAT(inspection.findings, Contains(HasSubstr("longest gap is 0.201 s")));
}

TEST(Inspect, ACoarseClockIsNoLoss) {
  Recording recording = rest_then_shake();
  // 400 Hz on a clock of 1 ms: steps of 2 and 3 ms.
  for (std::size_t i = 0; i < recording.probe.size(); ++i) {
    recording.probe.t_ns[i] = (2'500'000 * static_cast<std::int64_t>(i)) / 1'000'000 * 1'000'000;
  }
  const StreamTiming timing = inspect_recording(recording).probe;
  EXPECT_EQ(timing.lost, 0u);
  EXPECT_NEAR(timing.period_s, 0.0025, 1e-6);
  EXPECT_NEAR(timing.jitter_s, 0.0005, 1e-6);
  EXPECT_EQ(timing.clock_step_ns, 1'000'000);
}

TEST(Inspect, SaysWhatIsWrong) {
  Recording recording = rest_then_shake();
  for (std::size_t i = 0; i < 100; ++i) recording.probe.accel_counts[3000 + i].z() = 32767.0;
  recording.calibration.accelerometer.B *= 1.1;
  recording.info.gravity_world_mps2 = {0.0, 0.0, -9.81};
  recording.info.probe_rate_Hz = 500.0;
  recording.tracker.T_world_marker[150].rotation = exp_rotation(Eigen::Vector3d(0.0, 1.0, 0.0));
  recording.tracker.T_world_marker[151].rotation = exp_rotation(Eigen::Vector3d(0.0, 1.0, 0.0));
  recording.calibration.tracker.sigma_position_m.setConstant(1e-5);
  recording.calibration.force.offset_newton = -2.0;
  const Inspection inspection = inspect_recording(recording);
  EXPECT_EQ(inspection.flips, 2u);
  EXPECT_NEAR(inspection.channels[2].saturated_share, 100.0 / 4000.0, 1e-12);
  for (const char* expected :
       {"accel_k is at the end of its range in 2.50 %", "its calibration does not fit", "90.0° from the world's",
        "runs at 1000 Hz where its nominal rate is 500 Hz", "2 poses are far from their neighbours",
        "The noise of the stationary tracker is", "its offset is wrong"}) {
    EXPECT_THAT(inspection.findings, Contains(HasSubstr(expected)));
  }
}

TEST(Inspect, AMoveDuringAGapIsNoFlip) {
  Recording recording = rest_then_shake();
  // Half a metre in the second that the tracker missed.
  for (std::size_t i = 100; i < 200; ++i) {
    recording.tracker.t_ns[i] += 1'000'000'000;
    recording.tracker.T_world_marker[i].translation_m.z() += 0.5;
  }
  EXPECT_EQ(inspect_recording(recording).flips, 0u);
}

TEST(Inspect, StreamsThatDoNotMeet) {
  Recording recording = rest_then_shake();
  for (auto& t_ns : recording.tracker.t_ns) t_ns += 3600'000'000'000;
  const Inspection inspection = inspect_recording(recording);
  EXPECT_EQ(inspection.overlap_s, 0.0);
  EXPECT_THAT(inspection.findings, Contains(HasSubstr("do not overlap")));
}

TEST(Inspect, OneRowOfEach) {
  Recording recording = rest_then_shake();
  recording.probe.t_ns.resize(1);
  recording.probe.accel_counts.resize(1);
  recording.probe.force_counts.resize(1);
  recording.tracker.t_ns.resize(1);
  recording.tracker.T_world_marker.resize(1);
  validate_recording(recording);
  const Inspection inspection = inspect_recording(recording);
  EXPECT_THAT(inspection.findings, Contains(HasSubstr("single row")));
  EXPECT_THAT(inspection_json(inspection).dump(2), HasSubstr("\"median_rate_hz\": null"));
  EXPECT_THAT(inspection_text(inspection), HasSubstr("What looks wrong"));
}

}  // namespace
}  // namespace asperity
