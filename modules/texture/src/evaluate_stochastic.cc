#include "asperity/texture/evaluate_stochastic.h"

#include <algorithm>
#include <cmath>

#include "series_steps.h"

namespace asperity {
namespace {

double scaled_sigma_m(const StochasticTexture& t, double speed_mps, double force_N) noexcept {
  double scale = fade_factor(speed_mps, t.fade_speed_mps);
  if (t.speed_exponent != 0.0) scale *= std::pow(speed_mps / t.reference_speed_mps, t.speed_exponent);
  if (t.force_exponent != 0.0) scale *= std::pow(force_N / t.reference_force_N, t.force_exponent);
  // 0 · ∞ where an exponent is negative is not a number: nothing is rendered then.
  return scale > 0.0 ? t.sigma_m * std::min(scale, kMostStochasticScale) : 0.0;
}

double next_deviate(const StochasticTexture& t, SeriesState& state, double speed_mps, double dt_s) noexcept {
  const double fresh = fixed_time_normal(state.random);
  if (!(t.correlation_length_m > 0.0)) return fresh;
  state.phase += speed_mps * dt_s / t.correlation_length_m;
  if (state.phase >= 1.0) {
    // Where a step crosses several impulses, those between were never under the tip.
    state.previous = state.phase < 2.0 ? state.current : fixed_time_normal(state.random);
    state.current = fresh;
    state.phase -= std::floor(state.phase);
    if (!(state.phase >= 0.0 && state.phase < 1.0)) state.phase = 0.0;
  }
  const double u = state.phase;
  const double v = 1.0 - u;
  return (v * state.previous + u * state.current) / std::sqrt(v * v + u * u);
}

}  // namespace

StochasticHeight next_stochastic_height(const StochasticTexture& texture, SeriesState& state, double speed_mps,
                                        double force_N, double dt_s) noexcept {
  speed_mps = servo_input(speed_mps);
  const double sigma_m = scaled_sigma_m(texture, speed_mps, servo_input(force_N));
  const double z_m = sigma_m * next_deviate(texture, state, speed_mps, servo_input(dt_s));
  const double height_m = with_offset(z_m, sigma_m, texture.offset_sigmas);
  return {height_m, height_m - std::max(texture.offset_sigmas, 0.0) * sigma_m};
}

double next_height_m(const StochasticTexture& texture, SeriesState& state, double speed_mps, double force_N,
                     double dt_s) noexcept {
  return next_stochastic_height(texture, state, speed_mps, force_N, dt_s).height_m;
}

SeriesForce next_force(const StochasticTexture& texture, SeriesState& state, double speed_mps, double force_N,
                       double dt_s) noexcept {
  const StochasticHeight next = next_stochastic_height(texture, state, speed_mps, force_N, dt_s);
  return {texture.stiffness_N_per_m * next.height_m,
          texture.tangential_ratio * texture.stiffness_N_per_m * next.above_mean_m};
}

}  // namespace asperity
