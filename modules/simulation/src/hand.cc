#include "asperity/simulation/hand.h"

#include <algorithm>
#include <cmath>

#include "streams.h"

namespace asperity {
namespace {

// Slow voluntary variations of speed, force and position.
constexpr double kSlowLow_Hz = 0.2;
constexpr double kSpeedHigh_Hz = 1.5;
constexpr double kForceHigh_Hz = 1.0;
constexpr double kWanderLow_Hz = 0.05;

// 0 to 1 with two continuous derivatives.
double quintic_step(double u) {
  const double c = std::clamp(u, 0.0, 1.0);
  return c * c * c * (10.0 + c * (6.0 * c - 15.0));
}

RandomWave wave(double rms, double low_Hz, double high_Hz, double step_s, std::uint64_t seed, Stream s) {
  Random random(seed, stream(s));
  return {rms, low_Hz, high_Hz, step_s, random};
}

}  // namespace

Hand::Hand(const HandConfig& config, double length_m, double step_s, std::uint64_t seed)
    : config_(config), step_s_(step_s), stroke_s_(length_m / config.speed_mps + config.speed_ramp_s) {
  const HandConfig& c = config_;
  // To stop and to start again takes the way of one ramp.
  const double travel_s = stroke_s_;
  for (int i = 1; i <= c.pauses; ++i) {
    pause_starts_s_.push_back(c.rest_s + travel_s * i / (c.pauses + 1) + (i - 1) * (c.pause_s + c.speed_ramp_s) +
                              0.5 * c.speed_ramp_s);
  }
  stroke_s_ += c.pauses * (c.pause_s + c.speed_ramp_s);
  speed_wave_ = wave(c.speed_variation, kSlowLow_Hz, kSpeedHigh_Hz, step_s, seed, Stream::kSpeed);
  force_wave_ = wave(c.force_variation, kSlowLow_Hz, kForceHigh_Hz, step_s, seed, Stream::kForce);
  lateral_wave_ = wave(c.tremor_lateral_m, c.tremor_low_Hz, c.tremor_high_Hz, step_s, seed, Stream::kLateral);
  normal_wave_ = wave(c.tremor_normal_m, c.tremor_low_Hz, c.tremor_high_Hz, step_s, seed, Stream::kNormal);
  along_wave_ = wave(c.tremor_along_m, c.tremor_low_Hz, c.tremor_high_Hz, step_s, seed, Stream::kAlong);
  Random wander(seed, stream(Stream::kWander));
  Random tremor(seed, stream(Stream::kTremor));
  for (std::size_t axis = 0; axis < 3; ++axis) {
    rotation_wander_[axis] = {c.tilt_wander_rad, kWanderLow_Hz, c.tilt_wander_Hz, step_s, wander};
    rotation_tremor_[axis] = {c.tremor_rotation_rad, c.tremor_low_Hz, c.tremor_high_Hz, step_s, tremor};
  }

  const auto steps = static_cast<std::int64_t>(std::ceil((2.0 * c.rest_s + stroke_s_) / step_s));
  duration_s_ = static_cast<double>(steps) * step_s;
  RandomWave variation = speed_wave_;
  double travelled_m = 0.0;
  for (std::int64_t i = 0; i < steps; ++i) {
    travelled_m += speed(static_cast<double>(i) * step_s, variation.next()) * step_s;
  }
  speed_scale_ = length_m / travelled_m;

  for (int i = 0; i < c.lifts; ++i) {
    const double centre_s = start_s() + stroke_s_ * (i + 0.5) / c.lifts;
    lift_starts_s_.push_back(centre_s - 0.5 * c.lift_s);
  }
}

double Hand::between_pauses(double t_s) const {
  double open = 1.0;
  for (const double start_s : pause_starts_s_) {
    const double ramp_s = config_.speed_ramp_s;
    open *= quintic_step((start_s - t_s) / ramp_s) + quintic_step((t_s - start_s - config_.pause_s) / ramp_s);
  }
  return open;
}

double Hand::speed(double t_s, double variation) const {
  const double ramp_s = config_.speed_ramp_s;
  double open = quintic_step((t_s - start_s()) / ramp_s) * quintic_step((end_s() - t_s) / ramp_s);
  if (!pause_starts_s_.empty()) open *= between_pauses(t_s);
  return speed_scale_ * config_.speed_mps * std::max(0.1, 1.0 + variation) * open;
}

double Hand::greatest_force_N() const {
  const double most =
      config_.force == HandForce::kRamp ? std::max(config_.ramp_from_N, config_.ramp_to_N) : config_.force_N;
  return most * (1.0 + 4.0 * config_.force_variation);
}

HandState Hand::next() {
  HandState state;
  state.t_s = static_cast<double>(index_) * step_s_;
  state.v_mps = speed(state.t_s, speed_wave_.next());
  state.s_m = s_m_;
  s_m_ += state.v_mps * step_s_;
  ++index_;

  double lift = 0.0;
  for (const double start_s : lift_starts_s_) {
    const double u = (state.t_s - start_s) / config_.lift_s;
    if (u <= 0.0 || u >= 1.0) continue;
    state.lifting = true;
    lift = quintic_step(u / 0.3) * quintic_step((1.0 - u) / 0.3);
  }
  state.lift_m = lift * config_.lift_height_m;

  double set_N = config_.force_N;
  if (config_.force == HandForce::kRamp) {
    const double share = std::clamp((state.t_s - start_s()) / stroke_s_, 0.0, 1.0);
    set_N = config_.ramp_from_N + share * (config_.ramp_to_N - config_.ramp_from_N);
  }
  state.force_N = set_N * std::max(0.0, 1.0 + force_wave_.next()) * (1.0 - lift);
  state.tremor_m = normal_wave_.next();
  state.lateral_m = lateral_wave_.next();
  state.along_m = along_wave_.next();
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    const auto k = static_cast<std::size_t>(axis);
    state.rotation_rad[axis] = rotation_wander_[k].next() + rotation_tremor_[k].next();
  }
  return state;
}

}  // namespace asperity
