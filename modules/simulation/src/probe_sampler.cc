#include "asperity/simulation/probe_sampler.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "noise_bandwidth.h"
#include "normal_vector.h"
#include "streams.h"

namespace asperity {
namespace {

constexpr double kFirstSample_s = 1e-3;

std::uint64_t seed_of(const SimulationConfig& config) { return static_cast<std::uint64_t>(config.seed); }

// The length of a burst with the given mean, at least 1, geometric.
std::int64_t burst(double mean, Random& random) {
  if (mean <= 1.0) return 1;
  return 1 + static_cast<std::int64_t>(std::log(1.0 - random.uniform()) / std::log(1.0 - 1.0 / mean));
}

}  // namespace

ProbeSampler::ProbeSampler(const SimulationConfig& config, const Calibration& truth_calibration, std::int64_t start_ns)
    : config_(config.probe),
      calibration_(truth_calibration),
      gravity_world_mps2_(config.gravity_world_mps2.data()),
      force_axis_in_marker_(-truth_calibration.tip_in_marker_m.normalized()),
      start_ns_(start_ns),
      step_s_(config.step_s),
      last_stamp_ns_(std::numeric_limits<std::int64_t>::min()),
      accel_low_pass_(config.probe.accel_bandwidth_Hz, config.probe.accel_poles, 1.0 / config.step_s),
      gyro_low_pass_(config.probe.gyro_bandwidth_Hz, config.probe.accel_poles, 1.0 / config.step_s),
      force_low_pass_(config.probe.force_bandwidth_Hz, 1, 1.0 / config.step_s),
      force3_low_pass_(config.probe.force_bandwidth_Hz, 1, 1.0 / config.step_s),
      accel_noise_(seed_of(config), stream(Stream::kAccelNoise)),
      gyro_noise_(seed_of(config), stream(Stream::kGyroNoise)),
      force_noise_(seed_of(config), stream(Stream::kForceNoise)),
      clock_(seed_of(config), stream(Stream::kProbeClock)),
      radio_(seed_of(config), stream(Stream::kRadio)),
      wander_random_(seed_of(config), stream(Stream::kProbeWander)),
      flicker_random_(seed_of(config), stream(Stream::kFlicker)),
      force3_noise_(seed_of(config), stream(Stream::kForce3Noise)),
      wander_(config.probe.clock_wander_s, config.probe.clock_wander_time_s, wander_random_) {
  for (FlickerNoise& axis : accel_flicker_) axis = FlickerNoise(config_.accel_flicker_mps2, flicker_random_);
  for (FlickerNoise& axis : gyro_flicker_) axis = FlickerNoise(config_.gyro_flicker_radps, flicker_random_);
  Random warming(seed_of(config), stream(Stream::kWarming));
  warming_mps2_ = config_.accel_warming_mps2 * normal_vector(warming);
}

void ProbeSampler::push(const MotionState& state) {
  const Eigen::Vector3d lever_m = *calibration_.accelerometer.position_in_marker_m - calibration_.tip_in_marker_m;
  const Kinematics now{state, state.p_world_tip_m + state.q_world_marker * lever_m};
  ++pushed_;
  if (pushed_ >= 3) {
    // The signals one step ago, from the states on both sides of it.
    Signal signal;
    signal.t_s = current_.state.t_s;
    const Eigen::Vector3d a_world_mps2 = ((now.p_world_sensor_m - current_.p_world_sensor_m) -
                                          (current_.p_world_sensor_m - previous_.p_world_sensor_m)) /
                                         (step_s_ * step_s_);
    const Eigen::Quaterniond q_marker_world = current_.state.q_world_marker.conjugate();
    signal.specific_force_mps2 = accel_low_pass_.push(q_marker_world * (a_world_mps2 - gravity_world_mps2_));
    signal.omega_radps = gyro_low_pass_.push(
        log_rotation(previous_.state.q_world_marker.conjugate() * state.q_world_marker) / (2.0 * step_s_));
    signal.force_N =
        force_low_pass_.push((q_marker_world * current_.state.contact_force_world_N).dot(force_axis_in_marker_));
    if (config_.force3) signal.force3_N = force3_low_pass_.push(q_marker_world * current_.state.contact_force_world_N);
    if (pushed_ >= 4) {
      while (true) {
        const double rate_Hz = config_.true_rate_Hz * (1.0 + 1e-6 * config_.clock_drift_ppm);
        const double t_s = kFirstSample_s + static_cast<double>(taken_) / rate_Hz;
        if (t_s > signal.t_s) break;
        const double share = std::clamp((t_s - last_signal_.t_s) / step_s_, 0.0, 1.0);
        Signal sampled;
        sampled.t_s = t_s;
        sampled.specific_force_mps2 = lerp(last_signal_.specific_force_mps2, signal.specific_force_mps2, share);
        sampled.omega_radps = lerp(last_signal_.omega_radps, signal.omega_radps, share);
        sampled.force3_N = lerp(last_signal_.force3_N, signal.force3_N, share);
        sampled.force_N = last_signal_.force_N + share * (signal.force_N - last_signal_.force_N);
        take(sampled, previous_.state, current_.state, share);
      }
    }
    last_signal_ = signal;
  }
  previous_ = current_;
  current_ = now;
}

void ProbeSampler::finish() {
  if (!batch_.empty() && !truth.t_ns.empty()) end_batch(1e-9 * static_cast<double>(truth.t_ns.back() - start_ns_));
}

double ProbeSampler::count(double value) const {
  return config_.quantise ? std::clamp(std::round(value), config_.adc_min, config_.adc_max) : value;
}

Eigen::Vector3d ProbeSampler::slow_accel_mps2(double t_s) {
  Eigen::Vector3d out = warming_mps2_ * (1.0 - std::exp(-t_s / config_.warming_s));
  if (config_.accel_flicker_mps2 > 0.0) {
    for (std::size_t axis = 0; axis < 3; ++axis)
      out[static_cast<Eigen::Index>(axis)] += accel_flicker_[axis].next(1.0 / config_.true_rate_Hz, flicker_random_);
  }
  return out;
}

// The batch has arrived at `t_s` and its wait: its last sample is stamped then, the others evenly before it.
void ProbeSampler::end_batch(double t_s) {
  const double wait_s = -config_.batch_delay_s * (1.0 + std::log(1.0 - clock_.uniform()));
  const std::size_t first = samples.t_ns.size() - batch_.size();
  const std::int64_t before = first > 0 ? samples.t_ns[first - 1] : std::numeric_limits<std::int64_t>::min();
  last_stamp_ns_ = before;
  for (std::size_t k = 0; k < batch_.size(); ++k) {
    const double early_s = static_cast<double>(taken_ - 1 - batch_[k]) / config_.true_rate_Hz;
    samples.t_ns[first + k] = stamp_ns(t_s + wait_s - early_s);
  }
  batch_.clear();
  batch_first_ = taken_;
}

std::int64_t ProbeSampler::stamp_ns(double t_s) {
  double stamp_s = t_s;
  if (config_.clock_wander_s > 0.0) stamp_s += wander_.next(1.0 / config_.true_rate_Hz, wander_random_);
  if (config_.clock_jitter_s > 0.0) stamp_s += config_.clock_jitter_s * clock_.normal();
  if (config_.delivery_delay_s > 0.0) stamp_s -= config_.delivery_delay_s * std::log(1.0 - clock_.uniform());
  const auto step_ns = std::max<std::int64_t>(1, std::llround(config_.clock_step_s * 1e9));
  std::int64_t stamp = start_ns_ + std::llround(stamp_s * 1e9);
  stamp -= stamp % step_ns;
  // The link keeps the order of its frames, and a host does not read two of them in one tick.
  if (last_stamp_ns_ != std::numeric_limits<std::int64_t>::min()) stamp = std::max(stamp, last_stamp_ns_ + step_ns);
  last_stamp_ns_ = stamp;
  return stamp;
}

void ProbeSampler::take(const Signal& signal, const MotionState& before, const MotionState& after, double share) {
  const double rate_Hz = config_.true_rate_Hz;
  ++taken_;
  truth.t_ns.push_back(start_ns_ + std::llround(signal.t_s * 1e9));
  truth.s_m.push_back(before.s_m + share * (after.s_m - before.s_m));
  truth.height_m.push_back(before.height_m + share * (after.height_m - before.height_m));
  truth.p_world_tip_m.push_back(lerp(before.p_world_tip_m, after.p_world_tip_m, share));
  truth.q_world_marker.push_back(slerp(before.q_world_marker, after.q_world_marker, share));
  truth.force_N.push_back(before.normal_force_N + share * (after.normal_force_N - before.normal_force_N));

  const double accel_sigma = config_.accel_noise_mps2_per_rtHz *
                             std::sqrt(noise_bandwidth_Hz(config_.accel_bandwidth_Hz, config_.accel_poles, rate_Hz));
  const Eigen::Vector3d f_mps2 =
      signal.specific_force_mps2 + accel_sigma * normal_vector(accel_noise_) + slow_accel_mps2(signal.t_s);
  Eigen::Vector3d accel = calibration_.accelerometer.B * f_mps2 + calibration_.accelerometer.C;
  Eigen::Vector3d gyro = Eigen::Vector3d::Zero();
  if (calibration_.gyroscope) {
    const double gyro_sigma = config_.gyro_noise_radps_per_rtHz *
                              std::sqrt(noise_bandwidth_Hz(config_.gyro_bandwidth_Hz, config_.accel_poles, rate_Hz));
    Eigen::Vector3d omega_radps = signal.omega_radps + gyro_sigma * normal_vector(gyro_noise_);
    if (config_.gyro_flicker_radps > 0.0) {
      for (std::size_t axis = 0; axis < 3; ++axis)
        omega_radps[static_cast<Eigen::Index>(axis)] += gyro_flicker_[axis].next(1.0 / rate_Hz, flicker_random_);
    }
    gyro = calibration_.gyroscope->B * omega_radps + calibration_.gyroscope->C;
  }
  double force = std::numeric_limits<double>::quiet_NaN();
  Eigen::Vector3d force3 = Eigen::Vector3d::Constant(force);
  if (force_phase_ >= 1.0) {
    force_phase_ -= 1.0;
    const double force_N = signal.force_N + config_.force_noise_N * force_noise_.normal();
    force = count((force_N - calibration_.force.offset_newton) / calibration_.force.newton_per_count);
    if (calibration_.force3) {
      const Eigen::Vector3d force3_N = signal.force3_N + config_.force3_noise_N * normal_vector(force3_noise_);
      force3 = calibration_.force3->B * force3_N + calibration_.force3->C;
      for (double& axis : force3) axis = count(axis);
    }
  }
  force_phase_ = std::min(force_phase_ + config_.force_rate_Hz / rate_Hz, 2.0);

  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    accel[axis] = count(accel[axis]);
    gyro[axis] = count(gyro[axis]);
  }
  if (lost_left_ == 0 && radio_.chance(config_.dropout_chance)) lost_left_ = burst(config_.dropout_samples, radio_);
  if (radio_.chance(config_.spike_chance)) {
    const auto any = [&] { return std::round(radio_.uniform(config_.adc_min, config_.adc_max)); };
    for (Eigen::Index axis = 0; axis < 3; ++axis) accel[axis] = any();
    for (Eigen::Index axis = 0; axis < 3; ++axis) gyro[axis] = any();
    if (!std::isnan(force)) force = any();
    if (calibration_.force3 && !std::isnan(force)) force3 = {any(), any(), any()};
  }
  const bool ends_batch = config_.batch_samples > 1 && taken_ - batch_first_ >= config_.batch_samples;
  if (lost_left_ > 0) {
    --lost_left_;
  } else {
    // In a batch: until it has arrived.
    samples.t_ns.push_back(config_.batch_samples > 1 ? start_ns_ + std::llround(signal.t_s * 1e9)
                                                     : stamp_ns(signal.t_s));
    samples.accel_counts.push_back(accel);
    samples.force_counts.push_back(force);
    if (calibration_.gyroscope) samples.gyro_counts.push_back(gyro);
    if (calibration_.force3) samples.force3_counts.push_back(force3);
    if (config_.batch_samples > 1) batch_.push_back(taken_ - 1);
  }
  if (ends_batch) end_batch(signal.t_s);
}

}  // namespace asperity
