#include "asperity/pipeline/compare_with_tracker.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "asperity/base/random.h"
#include "asperity/pipeline/compare_specific_force.h"

namespace asperity {
namespace {

const Eigen::Vector3d kGravity_mps2(0.0, 9.80665, 0.0);
constexpr double kTwoPi = 2.0 * std::numbers::pi;

// Twelve seconds of a tip that travels back and forth in x as a hand does, in closed form; the sensor is at the tip.
struct Sweep {
  double amplitude_m = 0.0;
  double frequency_Hz = 0.0;
  Recording recording;
  TrajectoryResult trajectory;
  BasePathResult base;

  Sweep(double amplitude, double frequency, double pose_sigma_m) : amplitude_m(amplitude), frequency_Hz(frequency) {
    Random random(3);
    recording.info.gravity_world_mps2 = kGravity_mps2;
    recording.calibration.accelerometer.B = 200.0 * Eigen::Matrix3d::Identity();
    recording.calibration.tip_in_marker_m.setZero();
    double s_m = 0.0;
    for (int i = 0; i < 12'000; ++i) {
      const double t_s = 1e-3 * i, w = kTwoPi * frequency_Hz;
      const Eigen::Vector3d a_mps2(-amplitude_m * w * w * std::sin(w * t_s), 0.0, 0.0);
      recording.probe.t_ns.push_back(i * 1'000'000LL);
      recording.probe.accel_counts.emplace_back(200.0 * (a_mps2 - kGravity_mps2));
      recording.probe.force_counts.push_back(1.0);
      const Eigen::Vector3d p_m(amplitude_m * std::sin(w * t_s), 0.0, 0.3);
      trajectory.motion.t_ns.push_back(i * 1'000'000LL);
      trajectory.motion.p_world_tip_m.push_back(p_m);
      trajectory.motion.v_world_tip_mps.emplace_back(amplitude_m * w * std::cos(w * t_s), 0.0, 0.0);
      if (i > 0) s_m += std::abs(p_m.x() - base.path.p_world_m.back().x());
      base.path.p_world_m.push_back(p_m);
      base.path.n_world.emplace_back(0.0, 0.0, 1.0);
      base.path.s_m.push_back(s_m);
      base.contact.push_back(1);
      if (i % 20 != 0) continue;
      const Eigen::Vector3d noise_m(random.normal(), random.normal(), random.normal());
      recording.tracker.t_ns.push_back(i * 1'000'000LL);
      recording.tracker.T_world_marker.push_back({Eigen::Quaterniond::Identity(), p_m + pose_sigma_m * noise_m});
    }
  }
};

// A motion of 0.2 m at 2 Hz accelerates by up to 32 m/s²: gravity alone would explain none of the readings.
TEST(CompareSpecificForce, FastMotionIsNotAWrongUnit) {
  const Sweep sweep(0.2, 2.0, 0.3e-3);
  const SpecificForceComparison c = compare_specific_force(sweep.recording, 0.0, 0.0);
  EXPECT_GE(c.windows, 20U);
  EXPECT_NEAR(c.ratio, 1.0, 0.02);
  EXPECT_LT(c.difference_share, 0.03);
}

TEST(CompareSpecificForce, SeesUnitSignAndClipping) {
  Sweep sweep(0.02, 0.5, 0.3e-3);
  const auto compare = [&] { return compare_specific_force(sweep.recording, 0.0, 0.0); };
  sweep.recording.calibration.accelerometer.B *= 9.80665;
  EXPECT_NEAR(compare().ratio, 1.0 / 9.80665, 0.002);
  sweep.recording.calibration.accelerometer.B /= -9.80665;
  EXPECT_NEAR(compare().ratio, 1.0, 0.02);
  EXPECT_NEAR(compare().difference_share, 2.0, 0.02);
  // Gravity reads −1961 counts; a converter that ends at −1500 takes 24 % of it away.
  sweep.recording.calibration.accelerometer.B *= -1.0;
  sweep.recording.info.adc_min = -1500.0;
  sweep.recording.info.adc_max = 1500.0;
  for (Eigen::Vector3d& counts : sweep.recording.probe.accel_counts) counts = counts.cwiseMax(-1500.0);
  const SpecificForceComparison clipped = compare();
  EXPECT_EQ(clipped.windows, 0U);
  EXPECT_NEAR(clipped.clipped_ratio, 1500.0 / 1961.33, 0.01);
  EXPECT_NEAR(clipped.clipped_share, 1.0, 1e-9);
}

// The way of a sine is 4 A a period. Noise of 0.5 mm at 50 Hz would lengthen the poses' own polygon several times.
TEST(CompareWithTracker, FindsTheLengthUnderTheNoise) {
  const Sweep sweep(0.04, 0.25, 0.5e-3);
  const TrackerComparison c = compare_with_tracker(sweep.recording, sweep.trajectory, sweep.base);
  const double true_m = 4.0 * 0.04 * 0.25 * 11.98;
  EXPECT_NEAR(c.length_m, true_m, 1e-3);
  EXPECT_NEAR(c.tracker_length_m, true_m, 2.5 * c.tracker_length_stderr_m);
  EXPECT_LT(c.tracker_length_stderr_m, 0.03 * true_m);
  EXPECT_NEAR(c.pose_noise_m, 0.5e-3, 0.05e-3);  // 10 %: medians of 18 windows
  EXPECT_NEAR(c.departure_ratio, 1.1, 0.2);      // the median length of three equal axes over 0.8 of their RMS
}

// Noise that lasts for half a second is not in the poses' differences: the trajectory has learnt it, and each of the
// turns of the path counts it twice.
TEST(CompareWithTracker, TheSlowNoiseIsInTheLengthsError) {
  constexpr double kSlow_m = 1e-3, kTime_s = 0.5;
  constexpr int kScans = 40;
  const double true_m = 4.0 * 0.04 * 0.25 * 11.98;
  double squares = 0.0;
  for (std::uint64_t seed = 1; seed <= kScans; ++seed) {
    Sweep sweep(0.04, 0.25, 0.1e-3);
    Random random(seed, 3);
    Eigen::Vector3d slow_m = kSlow_m * Eigen::Vector3d(random.normal(), random.normal(), random.normal());
    std::int64_t before_ns = sweep.recording.tracker.t_ns.front();
    for (std::size_t i = 0; i < sweep.recording.tracker.size(); ++i) {
      const std::int64_t t_ns = sweep.recording.tracker.t_ns[i];
      const double keep = std::exp(-1e-9 * static_cast<double>(t_ns - before_ns) / kTime_s);
      before_ns = t_ns;
      slow_m = keep * slow_m + std::sqrt(1.0 - keep * keep) * kSlow_m *
                                   Eigen::Vector3d(random.normal(), random.normal(), random.normal());
      sweep.recording.tracker.T_world_marker[i].translation_m += slow_m;
    }
    sweep.trajectory.metrics["tracker_slow_sigma_m"] = kSlow_m;
    sweep.trajectory.metrics["tracker_slow_time_s"] = kTime_s;
    const TrackerComparison c = compare_with_tracker(sweep.recording, sweep.trajectory, sweep.base);
    squares += std::pow((c.tracker_length_m - true_m) / c.tracker_length_stderr_m, 2);
  }
  const double rms = std::sqrt(squares / kScans);
  std::printf("length's error over its standard error, RMS of %d: %.2f\n", kScans, rms);
  EXPECT_GT(rms, 0.5);
  EXPECT_LT(rms, 1.3);
}

// A stroke of 129 mm that comes to rest before, after and nearly on the way, as a hand's does: a parabola over a second
// and more bends it, and all wide ones by about as much as the next.
TEST(CompareWithTracker, WideParabolasDoNotBendAStrokeBetweenRests) {
  constexpr int kScans = 30, kParts = 3;
  constexpr double kPart_m = 0.043, kPart_s = 1.0, kRest_s = 0.6;
  double squares = 0.0, largest = 0.0;
  for (std::uint64_t seed = 1; seed <= kScans; ++seed) {
    Random random(seed, 5);
    Recording recording;
    recording.calibration.tip_in_marker_m.setZero();
    TrajectoryResult trajectory;
    BasePathResult base;
    for (int i = 0; i < static_cast<int>(1e3 * (kParts * kPart_s + 2.0 * kRest_s)); ++i) {
      // Each part from rest to rest with the least jerk.
      const double at = std::clamp((1e-3 * i - kRest_s) / kPart_s, 0.0, kParts - 1e-9);
      const double u = at - std::floor(at);
      const double x_m = kPart_m * (std::floor(at) + u * u * u * (10.0 - 15.0 * u + 6.0 * u * u));
      const double v_mps =
          at > 0.0 && at < kParts - 1e-6 ? kPart_m / kPart_s * 30.0 * u * u * (1.0 - u) * (1.0 - u) : 0.0;
      const Eigen::Vector3d p_m(x_m, 0.0, 0.3);
      trajectory.motion.t_ns.push_back(i * 1'000'000LL);
      trajectory.motion.p_world_tip_m.push_back(p_m);
      trajectory.motion.v_world_tip_mps.emplace_back(v_mps, 0.0, 0.0);
      base.path.p_world_m.push_back(p_m);
      base.path.n_world.emplace_back(0.0, 0.0, 1.0);
      base.path.s_m.push_back(x_m);
      base.contact.push_back(1);
      if (i % 11 != 0) continue;
      const Eigen::Vector3d noise_m(0.2e-3 * random.normal(), 0.3e-3 * random.normal(), 0.5e-3 * random.normal());
      recording.tracker.t_ns.push_back(i * 1'000'000LL);
      recording.tracker.T_world_marker.push_back({Eigen::Quaterniond::Identity(), p_m + noise_m});
    }
    const TrackerComparison c = compare_with_tracker(recording, trajectory, base);
    const double off = (c.tracker_length_m - kParts * kPart_m) / c.tracker_length_stderr_m;
    squares += off * off;
    largest = std::max(largest, std::abs(off));
  }
  std::printf("length's error over its standard error, RMS of %d: %.2f, largest %.2f\n", kScans,
              std::sqrt(squares / kScans), largest);
  EXPECT_LT(std::sqrt(squares / kScans), 1.25);
  EXPECT_LT(largest, 2.5);
}

TEST(CompareWithTracker, PosesFarOffDoNotLengthenThePath) {
  Sweep sweep(0.04, 0.25, 0.5e-3);
  for (const std::size_t i : {50U, 51U, 200U, 431U})
    sweep.recording.tracker.T_world_marker[i].translation_m.z() += 0.04;
  const TrackerComparison c = compare_with_tracker(sweep.recording, sweep.trajectory, sweep.base);
  EXPECT_NEAR(c.tracker_length_m, c.length_m, 2.5 * c.tracker_length_stderr_m);
  EXPECT_LT(c.tracker_length_stderr_m, 0.03 * c.length_m);
}

TEST(CompareWithTracker, SeesAPathThatLeavesThePoses) {
  Sweep sweep(0.04, 0.25, 0.5e-3);
  for (Eigen::Vector3d& p_m : sweep.trajectory.motion.p_world_tip_m) p_m.y() += 0.005;
  EXPECT_GT(compare_with_tracker(sweep.recording, sweep.trajectory, sweep.base).departure_ratio, 5.0);
}

// The scale by windows of a motion in closed form, whose accelerometer is biased: a tracker that is 3 % too large is
// found, and one that is right is not doubted.
TEST(CompareSpecificForce, WindowsGiveTheTrackersScale) {
  for (const double scale : {1.0, 1.03}) {
    Sweep sweep(0.05, 0.9, 20e-6);
    for (Pose& pose : sweep.recording.tracker.T_world_marker) pose.translation_m *= scale;
    for (Eigen::Vector3d& counts : sweep.recording.probe.accel_counts) counts.x() += 200.0 * 0.1;
    const SpecificForceComparison c = compare_specific_force(sweep.recording, 0.0, 0.0);
    ASSERT_TRUE(std::isfinite(c.tracker_scale_error_sigma));
    EXPECT_LT(c.tracker_scale_error_sigma, 5e-3);
    EXPECT_NEAR(c.tracker_scale_error, scale - 1.0, 4.0 * c.tracker_scale_error_sigma + 1e-3);
  }
}

// Poses between two samples of a slow sensor: a straight path at 0.5 m/s that is exactly theirs departs by nothing.
TEST(CompareWithTracker, PosesBetweenSamplesAreNotApart) {
  Recording recording;
  recording.calibration.tip_in_marker_m.setZero();
  TrajectoryResult trajectory;
  Random random(5);
  for (int i = 0; i < 1000; ++i) {
    const double t_s = 3.5e-3 * i;
    trajectory.motion.t_ns.push_back(static_cast<std::int64_t>(t_s * 1e9));
    trajectory.motion.p_world_tip_m.emplace_back(0.5 * t_s, 0.0, 0.0);
    trajectory.motion.v_world_tip_mps.emplace_back(0.5, 0.0, 0.0);
    const double pose_s = t_s + 1.4e-3;
    recording.tracker.t_ns.push_back(static_cast<std::int64_t>(pose_s * 1e9));
    const Eigen::Vector3d noise_m(random.normal(), random.normal(), random.normal());
    recording.tracker.T_world_marker.push_back(
        {Eigen::Quaterniond::Identity(), Eigen::Vector3d(0.5 * pose_s, 0.0, 0.0) + 20e-6 * noise_m});
  }
  const TrackerComparison c = compare_with_tracker(recording, trajectory, {});
  // The median length of noise of 20 µm an axis is 1.54 of it; with the nearest sample it would be 0.7 mm.
  EXPECT_NEAR(c.departure_m, 1.54 * 20e-6, 3e-6);
}

// The poses go where the tip goes, and not over the surface above it.
TEST(CompareWithTracker, OfASoftBodyTheTipsPathIsCompared) {
  Sweep sweep(0.05, 0.5, 0.2e-3);
  const TrackerComparison before = compare_with_tracker(sweep.recording, sweep.trajectory, sweep.base);
  sweep.base.tip_s_m = sweep.base.path.s_m;
  for (double& s_m : sweep.base.path.s_m) s_m *= 1.02;
  const TrackerComparison after = compare_with_tracker(sweep.recording, sweep.trajectory, sweep.base);
  EXPECT_GT(before.length_m, 0.1);
  EXPECT_EQ(after.length_m, before.length_m);
}

// Rows of 20 mm joined by half circles, from rest to rest. No smoothing of noisy poses sees all of the bends, and what
// it hides is in its error.
TEST(CompareWithTracker, TheTurnsOfARasterAreInTheLengthsError) {
  constexpr int kScans = 20, kRows = 7;
  constexpr double kRow_m = 0.02, kRadius_m = 0.6e-3, kSpeed_mps = 0.03, kRest_s = 0.5, kNoise_m = 0.45e-3;
  constexpr double kPeriod_m = kRow_m + std::numbers::pi * kRadius_m;
  constexpr double kTrue_m = kRows * kPeriod_m - std::numbers::pi * kRadius_m;
  double squares = 0.0;
  for (std::uint64_t seed = 1; seed <= kScans; ++seed) {
    Random random(seed, 9);
    Recording recording;
    recording.calibration.tip_in_marker_m.setZero();
    TrajectoryResult trajectory;
    BasePathResult base;
    for (int i = 0; i < static_cast<int>(1e3 * (kTrue_m / kSpeed_mps + 2.0 * kRest_s)); ++i) {
      const double s_m = std::clamp(kSpeed_mps * (1e-3 * i - kRest_s), 0.0, kTrue_m);
      const int row = std::min(kRows - 1, static_cast<int>(s_m / kPeriod_m));
      const double in_row_m = s_m - row * kPeriod_m, angle = std::max(0.0, in_row_m - kRow_m) / kRadius_m;
      const double reach_m = in_row_m < kRow_m ? in_row_m : kRow_m + kRadius_m * std::sin(angle);
      const double side = row % 2 == 0 ? 1.0 : -1.0;
      const Eigen::Vector3d p_m(row % 2 == 0 ? reach_m : kRow_m - reach_m,
                                2.0 * kRadius_m * row + kRadius_m * (1.0 - std::cos(angle)), 0.3);
      const bool moves = s_m > 0.0 && s_m < kTrue_m;
      trajectory.motion.t_ns.push_back(i * 1'000'000LL);
      trajectory.motion.p_world_tip_m.push_back(p_m);
      trajectory.motion.v_world_tip_mps.emplace_back(moves ? kSpeed_mps * side * std::cos(angle) : 0.0,
                                                     moves ? kSpeed_mps * std::sin(angle) : 0.0, 0.0);
      base.path.p_world_m.push_back(p_m);
      base.path.n_world.emplace_back(0.0, 0.0, 1.0);
      base.path.s_m.push_back(s_m);
      base.contact.push_back(1);
      if (i % 22 != 0) continue;  // 45 Hz
      const Eigen::Vector3d noise_m(random.normal(), random.normal(), random.normal());
      recording.tracker.t_ns.push_back(i * 1'000'000LL);
      recording.tracker.T_world_marker.push_back({Eigen::Quaterniond::Identity(), p_m + kNoise_m * noise_m});
    }
    const TrackerComparison c = compare_with_tracker(recording, trajectory, base);
    EXPECT_NEAR(c.length_m, kTrue_m, 0.1e-3);
    EXPECT_LT(c.tracker_length_stderr_m, 0.15 * kTrue_m) << seed;
    squares += std::pow((c.tracker_length_m - kTrue_m) / c.tracker_length_stderr_m, 2);
  }
  EXPECT_LT(std::sqrt(squares / kScans), 1.3);
  std::printf("length's error over its standard error, RMS of %d: %.2f\n", kScans, std::sqrt(squares / kScans));
}

}  // namespace
}  // namespace asperity
