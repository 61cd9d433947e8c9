#include "asperity/device/make_safe.h"

#include <algorithm>

#include "asperity/device/safety_cause.h"
#include "asperity/device/staleness.h"
#include "limit_force.h"

namespace asperity {
namespace {

// A loop that was not run may not make up for it: the gain and the rate limit see three ticks at most.
constexpr double kMostTicks = 3.0;

SafeForce nothing_on_fault(SafetyState& state) noexcept {
  state.gain = 0.0;
  state.held_N.setZero();
  state.out_N.setZero();
  state.passivity = {};
  SafeForce safe;
  safe.limited_by = flag(SafetyCause::kFault);
  return safe;
}

Eigen::Vector3d damping(const SafetyConfig& config, SafetyState& state, const SafetyInput& input) noexcept {
  PassivityInput observed;
  observed.hand_m = input.hand_m;
  observed.hand_mps = input.hand_mps;
  observed.stored_J = spring_energy_J(input.spring_N, input.stretch_m, config.max_force_N);
  observed.touching = !input.force_N.isZero(0.0);
  // A growing or falling gain is a spring whose stiffness changes: it creates energy by intent.
  observed.forgive = input.scene_changed || state.gain < 1.0;
  observed.dt_s = input.dt_s;
  return dissipate_created_energy(config, state.passivity, observed);
}

}  // namespace

SafetyConfig lower_to_device(SafetyConfig config, const DeviceInfo& info) {
  if (info.max_force_N < config.max_force_N) config.max_force_N = std::max(info.max_force_N, 0.0);
  if (!info.yields) config.passivity = false;
  return config;
}

SafeForce make_safe(const SafetyConfig& config, SafetyState& state, const SafetyInput& input) noexcept {
  if (input.status == DeviceStatus::kFault) return nothing_on_fault(state);

  SafeForce safe;
  const bool finite = input.force_N.allFinite() && input.hand_m.allFinite() && input.hand_mps.allFinite() &&
                      input.spring_N.allFinite() && input.stretch_m.allFinite();
  const double dt_s = std::min(input.dt_s, kMostTicks * input.tick_s);
  const bool stood_still = input.dt_s > config.stale_after_s && state.staleness.heard;
  const bool silent = is_stale(state.staleness, input.sequence, input.status, config.stale_after_s, input.dt_s);
  const bool stale = silent || stood_still;
  const bool stammering = is_stammering(state.stammer, stale, dt_s);
  if (!finite) safe.limited_by |= flag(SafetyCause::kNonFinite);
  if (stale || stammering) safe.limited_by |= flag(SafetyCause::kStale);
  if (input.ending) safe.limited_by |= flag(SafetyCause::kEnding);
  if (!input.permitted) safe.limited_by |= flag(SafetyCause::kNotPermitted);
  if (!input.plausible) safe.limited_by |= flag(SafetyCause::kImplausible);
  const bool well = safe.limited_by == 0;
  const bool returned = input.plausible && !state.plausible;
  state.plausible = input.plausible;
  state.gain = stood_still || returned ? 0.0 : next_gain(state.gain, well, config, dt_s);
  safe.gain = state.gain;
  if (well && state.gain < 1.0) safe.limited_by |= flag(SafetyCause::kSoftStart);

  if (finite && input.plausible) state.held_N = input.force_N;
  Eigen::Vector3d force_N = limit_force(state.held_N, config.max_force_N);
  if (force_N != state.held_N) safe.limited_by |= flag(SafetyCause::kForceLimit);
  force_N *= state.gain;

  if (!finite || !input.plausible || !config.passivity) {
    state.passivity = {};
  } else {
    const Eigen::Vector3d damping_N = damping(config, state, input);
    // Without news the velocity is not known; the energy goes on being observed.
    if (!stale && !damping_N.isZero(0.0)) {
      force_N += damping_N;
      safe.dissipated_J = -damping_N.dot(input.hand_mps) * input.dt_s;
      safe.limited_by |= flag(SafetyCause::kPassivity);
    }
  }

  const Eigen::Vector3d limited_N = limit_force(force_N, config.max_force_N);
  if (limited_N != force_N) safe.limited_by |= flag(SafetyCause::kForceLimit);
  safe.force_N = limit_force_rate(state.out_N, limited_N, config.max_force_rate_N_per_s, dt_s);
  if (safe.force_N != limited_N) safe.limited_by |= flag(SafetyCause::kRateLimit);
  state.out_N = safe.force_N;
  state.passivity.force_N = safe.force_N;
  return safe;
}

}  // namespace asperity
