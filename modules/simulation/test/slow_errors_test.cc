// What a real probe and tracker have beside white noise: rests on the way, clocks, slow errors, a marker that shakes, a
// force sensor of three axes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "asperity/geometry/pose.h"
#include "asperity/recording/validate_recording.h"
#include "asperity/simulation/gauss_markov.h"
#include "asperity/simulation/probe_truth.h"
#include "asperity/simulation/simulate_recording.h"
#include "asperity/simulation/tracker_sampler.h"

namespace asperity {
namespace {

SimulationConfig short_config() {
  SimulationConfig config = make_simulation_config("sandpaper", "open");
  config.hand.length_m = 0.02;
  config.hand.rest_s = 0.2;
  return config;
}

TEST(SlowErrors, GaussMarkovHasItsSpreadAndItsMemory) {
  Random random(3);
  double square = 0.0, product = 0.0;
  constexpr int kProcesses = 20000;
  for (int i = 0; i < kProcesses; ++i) {
    GaussMarkov process(2.0, 0.5, random);
    const double first = process.next(0.1, random);
    double later = 0.0;
    for (int k = 0; k < 5; ++k) later = process.next(0.1, random);
    square += later * later / kProcesses;
    product += first * later / kProcesses;
  }
  // A variance of 20000 values is right to 1 %; four of those.
  EXPECT_NEAR(square, 4.0, 0.16);
  EXPECT_NEAR(product, 4.0 * std::exp(-1.0), 0.12);
}

TEST(SlowErrors, TheHandRestsOnTheWayAndStillArrives) {
  SimulationConfig config = short_config();
  config.hand.pauses = 2;
  config.hand.pause_s = 0.8;
  const Recording with = simulate_recording(config);
  const Truth& truth = *with.truth;
  EXPECT_NEAR(truth.s_m.back() - truth.s_m.front(), 0.02, 0.3e-3);
  // Time below 0.5 mm/s, over windows of 50 ms: the two pauses, the rests before and after, but for tremor and the
  // ends.
  const std::size_t window = 200;
  double resting_s = 0.0;
  for (std::size_t i = 0; i + window < truth.size(); i += window) {
    const double way_m = std::abs(truth.s_m[i + window] - truth.s_m[i]);
    resting_s += way_m < 0.05 * 0.5e-3 ? 0.05 : 0.0;
  }
  EXPECT_NEAR(resting_s, 2.0 * 0.8 + 2.0 * 0.2, 0.35);
  const SimulationConfig plain = short_config();
  const double longer_s = 1e-9 * static_cast<double>(truth.t_ns.back() - truth.t_ns.front()) -
                          1e-9 * static_cast<double>(simulate_recording(plain).truth->t_ns.back() -
                                                     simulate_recording(plain).truth->t_ns.front());
  EXPECT_NEAR(longer_s, 2.0 * (0.8 + plain.hand.speed_ramp_s), 1e-3);
}

TEST(SlowErrors, BatchesAreStampedBackwardsFromTheirArrival) {
  SimulationConfig config = short_config();
  config.probe.clock_jitter_s = 0.0;
  config.probe.batch_samples = 16;
  config.probe.batch_delay_s = 1e-3;
  config.probe.dropout_chance = 0.0;
  const Recording recording = simulate_recording(config);
  EXPECT_NO_THROW(validate_recording(recording));
  const auto& t_ns = recording.probe.t_ns;
  ASSERT_EQ(t_ns.size(), recording.truth->size());
  double sum_s = 0.0;
  std::vector<double> errors_s;
  for (std::size_t i = 0; i < t_ns.size(); ++i) {
    const double error_s = 1e-9 * static_cast<double>(t_ns[i] - recording.truth->t_ns[i]);
    sum_s += error_s / static_cast<double>(t_ns.size());
    errors_s.push_back(error_s);
  }
  // Within a batch all are off by the same, but where the one before came so late that they would cross it.
  std::size_t within = 0, even = 0;
  for (std::size_t i = 1; i < t_ns.size(); ++i) {
    if (i % 16 == 0) continue;
    ++within;
    even += std::abs(errors_s[i] - errors_s[i - 1]) < 2e-9 ? 1 : 0;
  }
  EXPECT_GT(static_cast<double>(even), 0.8 * static_cast<double>(within));
  // The wait's mean is taken off; of an exponential wait of 1 ms over some 340 batches 0.05 ms are left, and those that
  // had to keep their order are late.
  EXPECT_NEAR(sum_s, 0.0, 0.25e-3);
  EXPECT_GT(*std::max_element(errors_s.begin(), errors_s.end()), 2e-3);
  EXPECT_GE(*std::min_element(errors_s.begin(), errors_s.end()), -1.001e-3);
}

TEST(SlowErrors, TheCrystalRunsFast) {
  SimulationConfig config = short_config();
  config.probe.clock_drift_ppm = 500.0;
  const Recording fast = simulate_recording(config);
  const Truth& truth = *fast.truth;
  const double span_s = 1e-9 * static_cast<double>(truth.t_ns.back() - truth.t_ns.front());
  EXPECT_NEAR(static_cast<double>(truth.size() - 1) / span_s, 4002.0, 0.01);
}

TEST(SlowErrors, WarmingAndFlickerAreInTheCounts) {
  SimulationConfig config = short_config();
  config.probe.quantise = false;
  const Recording plain = simulate_recording(config);
  config.probe.accel_warming_mps2 = 0.05;
  config.probe.warming_s = 0.3;
  const Recording warm = simulate_recording(config);
  const auto f_mps2 = [&](const Recording& r, std::size_t i) {
    return r.calibration.accelerometer.specific_force_mps2(r.probe.accel_counts[i]);
  };
  // The same noise in both: the difference is the warming alone, 1 − exp(−t/0.3 s) of its end.
  const Eigen::Vector3d end = f_mps2(warm, 4800) - f_mps2(plain, 4800);
  const Eigen::Vector3d early = f_mps2(warm, 1200) - f_mps2(plain, 1200);
  EXPECT_GT(end.norm(), 0.005);
  EXPECT_NEAR(early.norm() / end.norm(), (1.0 - std::exp(-0.301 / 0.3)) / (1.0 - std::exp(-1.201 / 0.3)), 0.002);
  EXPECT_EQ(plain.truth->p_world_tip_m, warm.truth->p_world_tip_m);

  config.probe.accel_warming_mps2 = 0.0;
  config.probe.accel_flicker_mps2 = 0.02;
  const Recording flickers = simulate_recording(config);
  double square = 0.0;
  for (std::size_t i = 0; i < flickers.probe.size(); ++i)
    square += (f_mps2(flickers, i) - f_mps2(plain, i)).squaredNorm() / static_cast<double>(flickers.probe.size()) / 3.0;
  // Over 1.5 s the slowest part does not show its whole spread.
  EXPECT_GT(std::sqrt(square), 0.01);
  EXPECT_LT(std::sqrt(square), 0.04);
}

TEST(SlowErrors, TheTrackerIsSlowlyOff) {
  SimulationConfig config = short_config();
  config.tracker.dropout_chance = config.tracker.flip_chance = 0.0;
  TrackerSampler plain(config, 0);
  config.tracker.slow_share = 2.0;
  config.tracker.slow_time_s = 0.5;
  TrackerSampler slow(config, 0);
  MotionState state;
  state.p_world_tip_m = {0.0, 0.1, 0.35};
  for (double t_s = 0.0; t_s < 120.0; t_s += 0.01) {
    state.t_s = t_s;
    plain.push(state);
    slow.push(state);
  }
  ASSERT_EQ(plain.poses.size(), slow.poses.size());
  // The frames' noise is the same: the difference is the slow error, twice as large, with a memory of 0.5 s.
  Eigen::Vector3d white = Eigen::Vector3d::Zero(), square = white, product = white;
  const Eigen::Vector3d p_m = state.p_world_tip_m - Eigen::Vector3d(config.probe.tip_in_marker_m.data());
  std::vector<Eigen::Vector3d> errors_m;
  for (std::size_t i = 0; i < slow.poses.size(); ++i) {
    white += (plain.poses.T_world_marker[i].translation_m - p_m).cwiseAbs2();
    errors_m.push_back(slow.poses.T_world_marker[i].translation_m - plain.poses.T_world_marker[i].translation_m);
  }
  constexpr std::size_t kLag = 60;  // 0.5 s at 120 Hz
  for (std::size_t i = kLag; i < errors_m.size(); ++i) {
    square += errors_m[i].cwiseAbs2();
    product += errors_m[i].cwiseProduct(errors_m[i - kLag]);
  }
  // 240 memories and 3 axes: a variance is right to 6 %.
  EXPECT_NEAR(std::sqrt(square.sum() / white.sum()), 2.0, 0.3);
  EXPECT_NEAR(product.sum() / square.sum(), std::exp(-1.0), 0.12);
  EXPECT_NEAR(slow.rms_position_m().norm() / plain.rms_position_m().norm(), std::sqrt(5.0), 1e-9);
}

TEST(SlowErrors, AShakenMarkerLagsItsMountByTheAccelerationOverItsStiffness) {
  SimulationConfig config = short_config();
  config.tracker.dropout_chance = config.tracker.flip_chance = 0.0;
  config.tracker.noise_m = config.tracker.noise_rad = {0.0, 0.0, 0.0};
  config.tracker.mount_Hz = 50.0;
  config.tracker.rate_Hz = 500.0;
  TrackerSampler tracker(config, 0);
  MotionState state;
  const double shaken_Hz = 10.0, amplitude_m = 1e-3, omega = 2.0 * std::numbers::pi * shaken_Hz;
  for (double t_s = 0.0; t_s < 2.0; t_s += config.step_s) {
    state.t_s = t_s;
    state.p_world_tip_m = {amplitude_m * std::sin(omega * t_s), 0.1, 0.35};
    tracker.push(state);
  }
  // Driven below its resonance a mass on a spring stands out by (ω/ω₀)²/(1 − (ω/ω₀)²) of the motion; its own ringing
  // has decayed by exp(−0.05·2π·50·1 s) after a second.
  const double ratio = std::pow(shaken_Hz / config.tracker.mount_Hz, 2);
  double most_m = 0.0;
  for (std::size_t i = 0; i < tracker.poses.size(); ++i) {
    if (tracker.poses.t_ns[i] < 1'200'000'000) continue;
    most_m = std::max(most_m, tracker.poses.T_world_marker[i].translation_m.x());
  }
  EXPECT_NEAR(most_m, amplitude_m * (1.0 + ratio / (1.0 - ratio)), 2e-6);
}

TEST(SlowErrors, ThreeAxesOfForceAreTheContactForce) {
  SimulationConfig config = short_config();
  config.probe.force3 = true;
  config.probe.force3_noise_N = 0.0;
  config.probe.force_bandwidth_Hz = 0.0;
  config.probe.force_rate_Hz = config.probe.true_rate_Hz;
  config.calibration.imperfection = 0.0;
  const Recording recording = simulate_recording(config);
  ASSERT_TRUE(recording.calibration.force3);
  ASSERT_EQ(recording.probe.force3_counts.size(), recording.probe.size());
  const Truth& truth = *recording.truth;
  const Eigen::Vector3d n_world = Eigen::Vector3d(config.shape.normal.data()).normalized();
  double worst_N = 0.0;
  for (std::size_t i = 0; i < recording.probe.size(); ++i) {
    const Eigen::Vector3d force_N =
        truth.q_world_marker[i] * recording.calibration.force3->force_N(recording.probe.force3_counts[i]);
    worst_N = std::max(worst_N, std::abs(force_N.dot(n_world) - truth.force_N[i]));
  }
  // A count is 0.3 mN; the truth's force is read at the sample's time, the sensor's by half a step of 25 µs beside it,
  // where an impact rises by hundreds of newtons a second.
  EXPECT_LT(worst_N, 0.02);

  // The slower sensor of the defaults leaves cells empty, all three at once.
  config = short_config();
  config.probe.force3 = true;
  const Recording slower = simulate_recording(config);
  for (std::size_t i = 0; i < slower.probe.size(); ++i) {
    EXPECT_EQ(std::isnan(slower.probe.force_counts[i]), slower.probe.force3_counts[i].hasNaN());
  }
  // A sensor more changes no other column.
  const Recording without = simulate_recording(short_config());
  EXPECT_EQ(without.probe.accel_counts, slower.probe.accel_counts);
  EXPECT_EQ(without.probe.t_ns, slower.probe.t_ns);
}

TEST(SlowErrors, TheTipsErrorIsStatedAsACalibrationStatesIt) {
  const SimulationConfig config;
  double sum = 0.0;
  constexpr int kSeeds = 400;
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    const Calibration truth = make_probe_truth(config.probe, config.tracker, seed);
    const Calibration stated = make_stated_calibration(truth, config.probe, config.calibration, Eigen::Vector3d::Ones(),
                                                       Eigen::Vector3d::Ones(), seed);
    ASSERT_TRUE(stated.tip_stderr_m());
    sum += ((stated.tip_in_marker_m - truth.tip_in_marker_m).array() / stated.tip_stderr_m()->array()).square().sum();
  }
  EXPECT_NEAR(sum / (3.0 * kSeeds), 1.0, 0.17);  // χ² of 1200, 4 σ
}

}  // namespace
}  // namespace asperity
