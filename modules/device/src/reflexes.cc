#include "asperity/device/reflexes.h"

#include <algorithm>
#include <cmath>

namespace asperity {

namespace {

constexpr double kNoise_m = 0.2e-3;  // of encoders
constexpr double kForget = 20.0;     // plausible time that makes up for implausible time
constexpr double kContradictionMemory_s = 0.02;
constexpr double kSpeedShare = 0.5;  // a velocity that is filtered lags behind

// The steps' velocity less the stated one, low-passed.
bool contradicts(const ReflexConfig& config, ReflexState& state, const DeviceReading& reading,
                 const Eigen::Vector3d& step_m, double step_s) noexcept {
  if (!reading.v_mps.allFinite()) return false;
  const double share = std::min(1.0, step_s / kContradictionMemory_s);
  state.contradiction_mps += share * (step_m / step_s - reading.v_mps - state.contradiction_mps);
  return state.contradiction_mps.norm() > config.contradicts_mps + kSpeedShare * reading.v_mps.norm();
}

bool frozen(const ReflexConfig& config, ReflexState& state, const DeviceReading& reading, double step_s) noexcept {
  const bool same =
      reading.p_m == state.newest_m && reading.v_mps.allFinite() && reading.v_mps.norm() >= config.frozen_speed_mps;
  state.frozen_s = same ? state.frozen_s + step_s : 0.0;
  return state.frozen_s >= config.frozen_after_s;
}

void believe(ReflexState& state, const DeviceReading& reading) noexcept {
  state.believed_m = reading.p_m;
  state.since_believed_s = 0.0;
}

}  // namespace

ReadingJudgement check_reading(const ReflexConfig& config, ReflexState& state, const DeviceReading& reading,
                               double dt_s) noexcept {
  ReadingJudgement out;
  state.since_believed_s += dt_s;
  state.since_new_s += dt_s;
  const bool news = reading.p_m.allFinite() && (!state.heard || reading.sequence != state.sequence) &&
                    reading.status == DeviceStatus::kReady;
  if (news && !state.heard) {
    state.heard = true;
    believe(state, reading);
  } else if (news) {
    const double step_s = state.since_new_s;
    const double jump_m = (reading.p_m - state.believed_m).norm();
    const bool jumps = jump_m > config.max_speed_mps * state.since_believed_s + kNoise_m;
    const bool stands = frozen(config, state, reading, step_s);
    const bool lies = !jumps && contradicts(config, state, reading, reading.p_m - state.newest_m, step_s);
    const bool was_plausible = state.plausible;
    state.plausible = !jumps && !stands && !lies;
    out.returned = state.plausible && !was_plausible;
    if (!jumps) believe(state, reading);
    if (out.returned) state.contradiction_mps.setZero();
  }
  if (news) {
    state.sequence = reading.sequence;
    state.newest_m = reading.p_m;
    state.since_new_s = 0.0;
  }
  state.distrust_s = state.plausible ? std::max(0.0, state.distrust_s - dt_s / kForget) : state.distrust_s + dt_s;
  out.plausible = state.plausible;
  // Half a tick of slack: a sum of ticks is not exactly a time.
  out.fault = !state.plausible && state.distrust_s + 0.5 * dt_s >= config.fault_after_s;
  return out;
}

bool was_suspended(SuspendWatch& watch, std::int64_t boot_ns, std::int64_t monotonic_ns, double most_s) noexcept {
  const std::int64_t offset_ns = boot_ns - monotonic_ns;
  const std::int64_t change_ns = watch.begun ? offset_ns - watch.offset_ns : 0;
  watch.begun = true;
  watch.offset_ns = offset_ns;
  return std::abs(static_cast<double>(change_ns)) * 1e-9 >= most_s;
}

}  // namespace asperity
