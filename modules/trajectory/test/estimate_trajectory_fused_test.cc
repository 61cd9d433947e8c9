#include "asperity/trajectory/estimate_trajectory_fused.h"

#include <gmock/gmock.h>
#include <cmath>

#include "asperity/base/error.h"
#include "asperity/base/random.h"
#include "hand_motion.h"

namespace asperity {
namespace {

using testing_motion::HandMotion;
using testing_motion::record;
using testing_motion::Sensors;

struct Errors {
  Eigen::Vector3d rms_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d normalised = Eigen::Vector3d::Zero();  // mean of (error/σ)²
  double rotation_rms_rad = 0.0;
  double velocity_rms_mps = 0.0;
  double step_rms_m = 0.0;  // error of the height's change over 50 ms
};

Errors errors_of(const TipMotion& motion, const HandMotion& hand) {
  Errors out;
  const auto n = static_cast<double>(motion.size());
  std::vector<double> height_error(motion.size());
  for (std::size_t i = 0; i < motion.size(); ++i) {
    const double t = static_cast<double>(motion.t_ns[i]) * 1e-9;
    const Eigen::Vector3d error = motion.p_world_tip_m[i] - hand.tip(t);
    const Eigen::Vector3d velocity = (hand.tip(t + 1e-5) - hand.tip(t - 1e-5)) / 2e-5;
    height_error[i] = error.y();
    out.rms_m += error.cwiseAbs2() / n;
    out.normalised += error.cwiseAbs2().cwiseQuotient(motion.cov_world_tip_m2[i].diagonal()) / n;
    out.rotation_rms_rad += log_rotation(motion.q_world_marker[i] * hand.orientation(t).conjugate()).squaredNorm() / n;
    out.velocity_rms_mps += (motion.v_world_tip_mps[i] - velocity).squaredNorm() / n;
  }
  std::size_t lag = 1;
  while (lag + 1 < motion.size() && motion.t_ns[lag] - motion.t_ns[0] < 50'000'000) ++lag;
  for (std::size_t i = lag; i < motion.size(); ++i) {
    out.step_rms_m += std::pow(height_error[i] - height_error[i - lag], 2) / static_cast<double>(motion.size() - lag);
  }
  out.rms_m = out.rms_m.cwiseSqrt();
  out.rotation_rms_rad = std::sqrt(out.rotation_rms_rad);
  out.velocity_rms_mps = std::sqrt(out.velocity_rms_mps);
  out.step_rms_m = std::sqrt(out.step_rms_m);
  return out;
}

TEST(Fused, ExactSensorsGiveTheExactPath) {
  HandMotion hand;
  Sensors sensors;
  sensors.accel_noise_mps2 = sensors.gyro_noise_radps = 0.0;
  sensors.tracker_sigma_m.setConstant(1e-6);
  sensors.tracker_rotation_sigma_rad = 1e-5;
  sensors.accel_bias.setZero();
  sensors.gyro_bias.setZero();
  sensors.counts_per_mps2 = 1600.0;
  const Errors errors = errors_of(estimate_trajectory_fused(record(hand, sensors), {}).motion, hand);
  EXPECT_LT(errors.rms_m.maxCoeff(), 5e-6);  // the trusted floor of the tracker is 10 µm
  EXPECT_LT(errors.step_rms_m, 2e-6);        // rounding to 1/1600 m/s² twice integrated over 50 ms
  EXPECT_LT(errors.rotation_rms_rad, 1e-3);
}

TEST(Fused, BeatsTheTrackerAndKnowsItsError) {
  HandMotion hand;
  Eigen::Vector3d normalised = Eigen::Vector3d::Zero();
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    Sensors sensors;
    sensors.seed = seed;
    const TrajectoryResult result = estimate_trajectory_fused(record(hand, sensors), {});
    const Errors errors = errors_of(result.motion, hand);
    EXPECT_LT(errors.rms_m.x(), 0.5 * sensors.tracker_sigma_m.x());
    EXPECT_LT(errors.rms_m.y(), 0.5 * sensors.tracker_sigma_m.y());
    EXPECT_LT(errors.rms_m.z(), 0.25 * sensors.tracker_sigma_m.z());
    EXPECT_LT(errors.step_rms_m, 12e-6);  // the texture's 50 µm stand far above
    EXPECT_LT(errors.velocity_rms_mps, 1e-3);
    // 3 standard errors that the estimate states itself, plus the discretisation of the times.
    EXPECT_NEAR(result.metrics.at("latency_s"), sensors.latency_s, 3.0 * result.metrics.at("latency_sigma_s") + 1e-4);
    normalised += errors.normalised / 4.0;
  }
  // The mean square of error over σ is 1 for honest error bars. A recording holds some tens of
  // independent low-frequency errors, so four of them scatter by about a third.
  EXPECT_THAT(normalised.x(), testing::AllOf(testing::Gt(0.4), testing::Lt(2.2)));
  EXPECT_THAT(normalised.y(), testing::AllOf(testing::Gt(0.4), testing::Lt(2.2)));
  EXPECT_THAT(normalised.z(), testing::AllOf(testing::Gt(0.4), testing::Lt(2.2)));
}

// A contact that rings above half the sampling rate leaves white noise along the surface's normal alone: its size is
// found, the error along the normal is as stated, and across it the path is far better than with such noise all around.
TEST(Fused, NoiseAlongOneDirectionIsTakenForThat) {
  HandMotion hand;
  hand.wander_rad = 0.01;
  constexpr double kNoise_mps2 = 2.0, kSeeds = 4.0;
  Eigen::Vector3d along_m2 = Eigen::Vector3d::Zero(), all_m2 = along_m2, normalised = along_m2;
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    Sensors sensors;
    sensors.seed = seed;
    sensors.rate_Hz = 400.0;
    sensors.tracker_rate_Hz = 45.0;
    sensors.gyro = false;
    sensors.accel_in_marker = sensors.tip_in_marker;
    Recording along = record(hand, sensors), all = along;
    Random noise(seed, 3);
    const double size = kNoise_mps2 * sensors.counts_per_mps2;
    for (std::size_t i = 0; i < along.probe.size(); ++i) {
      const Eigen::Vector3d counts = size * Eigen::Vector3d(noise.normal(), noise.normal(), noise.normal());
      along.probe.accel_counts[i].y() += counts.y();
      all.probe.accel_counts[i] += counts;
    }
    const TrajectoryResult result = estimate_trajectory_fused(along, {});
    EXPECT_NEAR(result.metrics.at("accel_fast_share"), 1.0, 0.3);
    const Errors errors = errors_of(result.motion, hand);
    along_m2 += errors.rms_m.cwiseAbs2() / kSeeds;
    normalised += errors.normalised / kSeeds;
    all_m2 += errors_of(estimate_trajectory_fused(all, {}).motion, hand).rms_m.cwiseAbs2() / kSeeds;
  }
  EXPECT_LT(along_m2.x(), 0.7 * all_m2.x());
  EXPECT_LT(along_m2.z(), 0.7 * all_m2.z());
  EXPECT_NEAR(normalised.y(), 1.0, 0.5);
}

TEST(Fused, WorksWithoutAGyroscope) {
  HandMotion hand;
  Sensors sensors;
  sensors.gyro = false;
  sensors.rate_Hz = 400.0;
  sensors.tracker_rate_Hz = 45.0;
  sensors.accel_in_marker = sensors.tip_in_marker;
  const Errors errors = errors_of(estimate_trajectory_fused(record(hand, sensors), {}).motion, hand);
  EXPECT_LT(errors.rms_m.y(), 0.6 * sensors.tracker_sigma_m.y());
  EXPECT_LT(errors.step_rms_m, 40e-6);
}

TEST(Fused, FlippedPosesAndSpikesLoseTheirWeight) {
  HandMotion hand;
  Sensors sensors;
  const Errors clean = errors_of(estimate_trajectory_fused(record(hand, sensors), {}).motion, hand);
  sensors.flip_share = 0.05;
  Recording recording = record(hand, sensors);
  Random random(7);
  for (std::size_t i = 100; i + 100 < recording.probe.size(); i += 997) {
    recording.probe.accel_counts[i] =
        Eigen::Vector3d(random.uniform(-32768, 32767), random.uniform(-32768, 32767), 31000.0);
  }
  const TrajectoryResult result = estimate_trajectory_fused(recording, {});
  const Errors errors = errors_of(result.motion, hand);
  EXPECT_LT(errors.rms_m.norm(), 1.5 * clean.rms_m.norm());
  EXPECT_LT(errors.step_rms_m, 2.0 * clean.step_rms_m);
  EXPECT_GE(result.metrics.at("poses_outlying"), 15.0);
  EXPECT_TRUE(result.trustworthy);
}

// A converter's glitch strikes one channel; an isolated count cannot come from a sensor behind a low-pass.
TEST(Fused, AGlitchInOneChannelIsReplaced) {
  HandMotion hand;
  Recording recording = record(hand, Sensors{});
  const Errors clean = errors_of(estimate_trajectory_fused(recording, {}).motion, hand);
  recording.probe.accel_counts[9000].y() += 20000.0;  // 96 m/s²
  const TrajectoryResult result = estimate_trajectory_fused(recording, {});
  EXPECT_LT(errors_of(result.motion, hand).step_rms_m, 1.1 * clean.step_rms_m);
}

TEST(Fused, SaturationAndLostSamplesStayLocal) {
  HandMotion hand;
  Sensors sensors;
  Recording recording = record(hand, sensors);
  for (std::size_t i = 8000; i < 8040; ++i) recording.probe.accel_counts[i].y() = 32767.0;  // 10 ms
  ProbeStream& probe = recording.probe;
  const auto erase = [](auto& list) { list.erase(list.begin() + 11000, list.begin() + 11120); };  // 30 ms
  erase(probe.t_ns), erase(probe.accel_counts), erase(probe.gyro_counts), erase(probe.force_counts);
  const Errors errors = errors_of(estimate_trajectory_fused(recording, {}).motion, hand);
  EXPECT_LT(errors.rms_m.maxCoeff(), 0.2e-3);  // near the tracker's own noise, not the metres of a free integral
}

TEST(Fused, EstimatesTheAccelerometersPosition) {
  HandMotion hand;
  hand.wander_rad = 0.3;
  Sensors sensors;
  sensors.duration_s = 15.0;
  Recording recording = record(hand, sensors);
  AccelerometerCalibration& accelerometer = recording.calibration.accelerometer;
  accelerometer.position_in_marker_m = Eigen::Vector3d::Zero();
  accelerometer.position_sigma_m = 0.05;
  // A scale that is known to 1e-4: with 1 % left open gravity turns by as much as the place's acceleration.
  accelerometer.standard_errors = Eigen::MatrixXd::Constant(3, 4, 1e-4 * sensors.counts_per_mps2);
  const TrajectoryResult result = estimate_trajectory_fused(recording, {});
  // The gyroscope's scale and gravity are open too: 5 mm, and within what it says itself (4 σ).
  for (int axis = 0; axis < 3; ++axis) {
    const std::string name = std::string("accelerometer_position_") + "xyz"[axis];
    const double error_m = std::abs(result.metrics.at(name + "_m") - sensors.accel_in_marker[axis]);
    EXPECT_LT(error_m, 5e-3) << name;
    EXPECT_LT(error_m, 4.0 * result.metrics.at(name + "_sigma_m")) << name;
  }
}

// Within what the estimate says itself: 4 σ an axis, of which a right one goes beyond once in 5000.
TEST(Fused, SaysHowWellItKnowsTheAccelerometersPosition) {
  HandMotion hand;
  hand.wander_rad = 0.3;
  Sensors sensors;
  sensors.duration_s = 10.0;
  Recording recording = record(hand, sensors);
  recording.calibration.accelerometer.position_in_marker_m.reset();
  const auto metrics = estimate_trajectory_fused(recording, {}).metrics;
  for (int axis = 0; axis < 3; ++axis) {
    const std::string name = std::string("accelerometer_position_") + "xyz"[axis];
    EXPECT_NEAR(metrics.at(name + "_m"), sensors.accel_in_marker[axis], 4.0 * metrics.at(name + "_sigma_m")) << name;
    EXPECT_LT(metrics.at(name + "_sigma_m"), 0.05) << name;
  }
}

TEST(Fused, EstimatesTheSensorsRotation) {
  HandMotion hand;
  hand.wander_rad = 0.3;
  Sensors sensors;
  Recording recording = record(hand, sensors);
  const Errors known = errors_of(estimate_trajectory_fused(recording, {}).motion, hand);
  const Eigen::Quaterniond turn(Eigen::AngleAxisd(2.0, Eigen::Vector3d(1, 2, -1).normalized()));
  for (auto& counts : recording.probe.accel_counts) counts = (turn * counts).eval();
  for (auto& counts : recording.probe.gyro_counts) counts = (turn * counts).eval();
  recording.calibration.accelerometer.rotation_known = false;
  const Errors errors = errors_of(estimate_trajectory_fused(recording, {}).motion, hand);
  EXPECT_LT(errors.step_rms_m, 2.0 * known.step_rms_m);
}

// A gyroscope calibrated in the marker's frame beside an accelerometer that is not; and a hand that turns
// by a few degrees only.
TEST(Fused, EstimatesTheAccelerometersRotationAlone) {
  HandMotion hand;
  Sensors sensors;
  sensors.duration_s = 8.0;
  Recording recording = record(hand, sensors);
  const Errors known = errors_of(estimate_trajectory_fused(recording, {}).motion, hand);
  for (const double angle : {0.7, 2.9}) {
    Recording turned = recording;
    const Eigen::Quaterniond turn(Eigen::AngleAxisd(angle, Eigen::Vector3d(1, 2, -1).normalized()));
    for (auto& counts : turned.probe.accel_counts) counts = (turn * counts).eval();
    turned.calibration.accelerometer.rotation_known = false;
    const Errors errors = errors_of(estimate_trajectory_fused(turned, {}).motion, hand);
    EXPECT_LT(errors.step_rms_m, 2.0 * known.step_rms_m) << angle;
  }
}

// Without a gyroscope the rate is a state in the marker's frame, which the sensor's rotation does not turn.
TEST(Fused, EstimatesTheSensorsRotationWithoutAGyroscope) {
  HandMotion hand;
  hand.wander_rad = 0.3;
  Sensors sensors;
  sensors.gyro = false;
  sensors.rate_Hz = 400.0;
  Recording recording = record(hand, sensors);
  const Errors known = errors_of(estimate_trajectory_fused(recording, {}).motion, hand);
  const Eigen::Quaterniond turn(Eigen::AngleAxisd(2.0, Eigen::Vector3d(1, 2, -1).normalized()));
  for (auto& counts : recording.probe.accel_counts) counts = (turn * counts).eval();
  recording.calibration.accelerometer.rotation_known = false;
  const Errors errors = errors_of(estimate_trajectory_fused(recording, {}).motion, hand);
  EXPECT_LT(errors.step_rms_m, 2.0 * known.step_rms_m);
}

TEST(Fused, TakesAGyroscopeSlowerThanTheRows) {
  HandMotion hand;
  Recording recording = record(hand, Sensors{});
  const Errors whole = errors_of(estimate_trajectory_fused(recording, {}).motion, hand);
  for (std::size_t i = 0; i < recording.probe.size(); ++i) {
    if (i % 8 != 3) recording.probe.gyro_counts[i].setConstant(std::nan(""));  // 500 Hz
  }
  const Errors errors = errors_of(estimate_trajectory_fused(recording, {}).motion, hand);
  EXPECT_LT(errors.rotation_rms_rad, 1.5 * whole.rotation_rms_rad);
  EXPECT_LT(errors.step_rms_m, 1.5 * whole.step_rms_m);
}

TEST(Fused, AGyroscopeThatNeverSpeaksIsNone) {
  HandMotion hand;
  Recording recording = record(hand, Sensors{});
  Recording without = recording;
  for (auto& counts : recording.probe.gyro_counts) counts.setConstant(std::nan(""));
  without.probe.gyro_counts.clear();
  EXPECT_EQ(estimate_trajectory_fused(recording, {}).motion.p_world_tip_m,
            estimate_trajectory_fused(without, {}).motion.p_world_tip_m);
}

TEST(Fused, SameInputSameOutput) {
  const Recording recording = record(HandMotion{}, Sensors{});
  const TipMotion a = estimate_trajectory_fused(recording, {}).motion;
  const TipMotion b = estimate_trajectory_fused(recording, {}).motion;
  EXPECT_EQ(a.p_world_tip_m, b.p_world_tip_m);
}

TEST(Fused, RefusesStreamsThatDoNotOverlap) {
  Recording recording = record(HandMotion{}, Sensors{});
  for (auto& t : recording.tracker.t_ns) t += 60'000'000'000;
  EXPECT_THAT([&] { estimate_trajectory_fused(recording, {}); },
              testing::ThrowsMessage<Error>(testing::HasSubstr("tracker.csv: only 0 poses lie within")));
}

}  // namespace
}  // namespace asperity
