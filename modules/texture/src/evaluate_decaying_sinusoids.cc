#include "asperity/texture/evaluate_decaying_sinusoids.h"

#include <algorithm>
#include <cmath>

#include "series_steps.h"

namespace asperity {

void start_tap(const DecayingSinusoids& t, SeriesState& state, double speed_mps, double force_N) noexcept {
  state.ringing[0] += t.a_per_s * servo_input(speed_mps) + t.b_per_kg * servo_input(force_N);
}

double next_acceleration_mps2(const DecayingSinusoids& t, SeriesState& state, double speed_mps, double force_N,
                              double dt_s) noexcept {
  dt_s = servo_input(dt_s);
  const double decay = std::exp(-t.decay_per_s * dt_s);
  const double angle = t.omega_rad_per_s * dt_s;
  const double c = decay * std::cos(angle);
  const double s = decay * std::sin(angle);
  const double x = state.ringing[0];
  const double y = state.ringing[1];
  state.ringing = {c * x - s * y, s * x + c * y};
  if (t.pitch_m > 0.0) {
    // More than one edge a step is felt as one.
    state.phase += std::min(servo_input(speed_mps) * dt_s / t.pitch_m, 1.0);
    if (state.phase >= 1.0) {
      state.phase = std::min(state.phase - 1.0, 1.0);
      start_tap(t, state, speed_mps, force_N);
    }
  }
  if (!std::isfinite(state.ringing[0]) || !std::isfinite(state.ringing[1])) state.ringing = {};
  return state.ringing[1];
}

SeriesForce next_force(const DecayingSinusoids& t, SeriesState& state, double speed_mps, double force_N,
                       double dt_s) noexcept {
  const double force = t.mass_kg * next_acceleration_mps2(t, state, speed_mps, force_N, dt_s);
  return {force, t.tangential_ratio * force};
}

}  // namespace asperity
