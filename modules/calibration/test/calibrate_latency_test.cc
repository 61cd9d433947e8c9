#include "asperity/calibration/calibrate_latency.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "asperity/base/error.h"
#include "coverage.h"
#include "shaken_probe.h"

namespace asperity {
namespace {

using test::ShakenProbe;

constexpr std::size_t kTrials = 200;

std::string refusal(const Recording& recording, const LatencyConfig& config = {}) {
  try {
    const LatencyFit fit = calibrate_latency(recording, config);
    return "not refused: " + fit.verdict.text;
  } catch (const Error& error) {
    return error.what();
  }
}

void add_rotation(test::Coverage& coverage, const LatencyFit& fit, const Eigen::Quaterniond& truth) {
  const Eigen::Vector3d error = log_rotation(fit.R_marker_sensor * truth.conjugate());
  for (int k = 0; k < 3; ++k) {
    coverage.add("rotation " + std::to_string(k), error[k], 0.0, fit.rotation_error_rad[k]);
  }
}

TEST(CalibrateLatency, GyroscopeStandardErrorsAreTrue) {
  test::Coverage coverage;
  for (std::size_t trial = 0; trial < kTrials; ++trial) {
    Random random(70, trial);
    ShakenProbe probe;
    probe.latency_s = random.uniform(-0.05, 0.3);
    const LatencyFit fit = calibrate_latency(test::shake(random, probe));
    coverage.add("latency", fit.latency_s, probe.latency_s, fit.latency_error_s);
    coverage.add("clock rate", fit.clock_rate, 0.0, fit.clock_rate_error);
    for (int k = 0; k < 3; ++k)
      coverage.add("bias " + std::to_string(k), fit.bias[k], probe.gyro_bias_radps[k], fit.bias_error[k]);
    if (trial == 0) std::printf("%s rate %g ± %g\n", fit.verdict.text.c_str(), fit.clock_rate, fit.clock_rate_error);
  }
  coverage.expect("latency by the gyroscope", kTrials);
}

TEST(CalibrateLatency, GyroscopeOfUnknownRotationAndScale) {
  test::Coverage coverage;
  for (std::size_t trial = 0; trial < kTrials; ++trial) {
    Random random(71, trial);
    ShakenProbe probe;
    const Eigen::Quaterniond rotation = exp_rotation({1.0, -2.0, 0.5});
    Recording recording = test::shake(random, probe);
    // The calibration knows the sensor's own axes only.
    for (Eigen::Vector3d& counts : recording.probe.gyro_counts) {
      const Eigen::Vector3d w =
          recording.calibration.gyroscope->B.inverse() * (counts - recording.calibration.gyroscope->C);
      counts = rotation.conjugate() * w / 0.001;
    }
    recording.calibration.gyroscope.reset();
    const LatencyFit fit = calibrate_latency(recording);
    ASSERT_TRUE(fit.rotation_solved && fit.scale_solved);
    coverage.add("latency", fit.latency_s, probe.latency_s, fit.latency_error_s);
    coverage.add("scale", fit.scale, 0.001, fit.scale_error);
    add_rotation(coverage, fit, rotation);
  }
  coverage.expect("latency by a gyroscope of unknown rotation and scale", kTrials);
}

TEST(CalibrateLatency, AccelerometerStandardErrorsAreTrue) {
  test::Coverage coverage;
  for (std::size_t trial = 0; trial < kTrials; ++trial) {
    Random random(72, trial);
    ShakenProbe probe;
    probe.gyro = false;
    probe.move_m = 0.03;
    probe.latency_s = random.uniform(-0.05, 0.3);
    const LatencyFit fit = calibrate_latency(test::shake(random, probe));
    coverage.add("latency", fit.latency_s, probe.latency_s, fit.latency_error_s);
    coverage.add("clock rate", fit.clock_rate, 0.0, fit.clock_rate_error);
    if (trial == 0) std::printf("%s rate %g ± %g\n", fit.verdict.text.c_str(), fit.clock_rate, fit.clock_rate_error);
  }
  coverage.expect("latency by the accelerometer", kTrials);
}

// The accelerometer's scales and axes are off by 0.3 %, its place by 0.3 mm an axis, as good calibrations leave them,
// and the tracker is good: what they make of the motion is no white noise.
TEST(CalibrateLatency, TheErrorsOfOtherCalibrationsAreInTheStandardError) {
  constexpr std::size_t kScans = 60;
  test::Coverage coverage;
  for (std::size_t trial = 0; trial < kScans; ++trial) {
    Random random(76, trial);
    ShakenProbe probe;
    probe.gyro = false;
    probe.move_m = 0.03;
    probe.length_s = 7.0;
    probe.probe_Hz = 1000.0;
    probe.tracker_sigma_m = 2e-5;
    probe.tracker_sigma_rad = 1e-4;
    probe.latency_s = random.uniform(-0.05, 0.3);
    Recording recording = test::shake(random, probe);
    Eigen::Matrix3d error;
    for (double& value : error.reshaped()) value = 3e-3 * random.normal();
    AccelerometerCalibration& accelerometer = recording.calibration.accelerometer;
    accelerometer.B = (accelerometer.B * (Eigen::Matrix3d::Identity() + error)).eval();
    accelerometer.position_in_marker_m =
        probe.lever_m + 3e-4 * Eigen::Vector3d(random.normal(), random.normal(), random.normal());
    accelerometer.position_sigma_m = 3e-4;
    const LatencyFit fit = calibrate_latency(recording);
    coverage.add("latency", fit.latency_s, probe.latency_s, fit.latency_error_s);
    if (trial == 0) std::printf("%s\n", fit.verdict.text.c_str());
  }
  coverage.expect("latency by an accelerometer of imperfect calibration", kScans);
}

TEST(CalibrateLatency, AccelerometerOfUnknownRotation) {
  test::Coverage coverage;
  for (std::size_t trial = 0; trial < kTrials; ++trial) {
    Random random(73, trial);
    ShakenProbe probe;
    probe.gyro = false;
    probe.move_m = 0.03;
    probe.R_marker_sensor = exp_rotation({0.4, 1.3, -0.7});
    Recording recording = test::shake(random, probe);
    recording.calibration.accelerometer.B = 200.0 * Eigen::Matrix3d::Identity();
    recording.calibration.accelerometer.rotation_known = false;
    const LatencyFit fit = calibrate_latency(recording);
    coverage.add("latency", fit.latency_s, probe.latency_s, fit.latency_error_s);
    add_rotation(coverage, fit, probe.R_marker_sensor);
  }
  coverage.expect("latency by an accelerometer of unknown rotation", kTrials);
}

TEST(CalibrateLatency, ClocksThatRunApart) {
  Random random(74);
  ShakenProbe probe;
  probe.clock_rate = 200e-6;
  probe.length_s = 60.0;
  const LatencyFit fit = calibrate_latency(test::shake(random, probe));
  EXPECT_NEAR(fit.clock_rate, 200e-6, 4.0 * fit.clock_rate_error);
  EXPECT_LT(fit.clock_rate_error, 10e-6);
  EXPECT_THAT(fit.verdict.text, testing::HasSubstr("ppm"));
}

TEST(CalibrateLatency, GapsAndFlipsAreLeftOut) {
  Random random(75);
  ShakenProbe probe;
  Recording recording = test::shake(random, probe);
  ProbeStream& p = recording.probe;
  for (const std::size_t at : {1600u, 800u}) {  // gaps of 0.4 s
    const auto cut = [&](auto& x) { x.erase(x.begin() + at, x.begin() + at + 80); };
    cut(p.t_ns);
    cut(p.accel_counts);
    cut(p.force_counts);
    cut(p.gyro_counts);
  }
  for (std::size_t i = 60; i < 560; i += 50) {
    recording.tracker.T_world_marker[i].rotation =
        exp_rotation({0.3, 0.0, 0.2}) * recording.tracker.T_world_marker[i].rotation;
  }
  const LatencyFit fit = calibrate_latency(recording);
  ASSERT_EQ(fit.problems.size(), 1u);
  EXPECT_GE(fit.problems[0].count, 8u);
  EXPECT_LE(fit.problems[0].count, 11u);
  EXPECT_NEAR(fit.latency_s, probe.latency_s, 4.0 * fit.latency_error_s);
}

TEST(CalibrateLatency, FlipsDoNotTurnTheAccelerometer) {
  Random random(81);
  ShakenProbe probe;
  probe.gyro = false;
  probe.move_m = 0.03;
  Recording recording = test::shake(random, probe);
  for (std::size_t i = 60; i < 560; i += 50) {
    recording.tracker.T_world_marker[i].rotation =
        exp_rotation({0.4, 0.0, 0.2}) * recording.tracker.T_world_marker[i].rotation;
  }
  const LatencyFit fit = calibrate_latency(recording);
  ASSERT_FALSE(fit.problems.empty());
  EXPECT_NEAR(fit.latency_s, probe.latency_s, 4.0 * fit.latency_error_s);
  EXPECT_LT(fit.latency_error_s, 1e-4);
}

TEST(CalibrateLatency, RefusesRegularMotion) {
  Random random(76);
  ShakenProbe probe;
  probe.regular_Hz = 4.0;
  EXPECT_THAT(refusal(test::shake(random, probe)), testing::HasSubstr("too regular"));
}

TEST(CalibrateLatency, RefusesWeakMotion) {
  Random random(77);
  ShakenProbe probe;
  probe.turn_rad = 0.0005;
  EXPECT_THAT(refusal(test::shake(random, probe)), testing::HasSubstr("shake the probe"));
}

TEST(CalibrateLatency, RefusesALatencyOutsideTheSearch) {
  Random random(78);
  const Recording recording = test::shake(random, {.latency_s = 0.2});
  EXPECT_THAT(refusal(recording, {.largest_latency_s = 0.18}), testing::HasSubstr("edge"));
}

TEST(CalibrateLatency, RefusesShortRecordings) {
  Random random(79);
  EXPECT_THAT(refusal(test::shake(random, {.length_s = 1.5})), testing::HasSubstr("poses"));
  EXPECT_THAT(refusal(Recording{}), testing::HasSubstr("0 rows"));
}

TEST(CalibrateLatency, TheProbesOwnLatencyIsTakenOff) {
  Random random(80);
  Recording recording = test::shake(random, {.latency_s = 0.05});
  recording.calibration.probe_latency_s = 0.01;
  const LatencyFit fit = calibrate_latency(recording);
  EXPECT_NEAR(fit.latency_s, 0.06, 4.0 * fit.latency_error_s);
}

}  // namespace
}  // namespace asperity
