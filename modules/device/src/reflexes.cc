#include "asperity/device/reflexes.h"

#include <algorithm>
#include <cmath>

namespace asperity {

namespace {

constexpr double kNoise_m = 0.2e-3;  // of encoders
constexpr double kForget = 20.0;     // plausible time that makes up for implausible time
constexpr double kForgetGaps = 10.0;
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

// Whether the place is where the last two were heading, as far as a hand can change its speed.
bool is_expected(const ReflexConfig& config, const ReflexState& state, const Eigen::Vector3d& p_m) noexcept {
  if (!state.has_step) return true;
  const double t_s = state.since_believed_s;
  // The velocity is that of the middle of the step before: it may have changed for half of that, too.
  const double allowed_m =
      std::min(0.5 * config.max_acceleration_mps2 * t_s * (t_s + state.step_s), config.largest_surprise_m);
  return (p_m - state.believed_m - t_s * state.step_mps).norm() <= allowed_m + 2.0 * kNoise_m;
}

// Whether the place is near that of the reading before, which was not believed.
bool is_confirmed(const ReflexConfig& config, const ReflexState& state, const Eigen::Vector3d& p_m,
                  double step_s) noexcept {
  const double allowed_m = std::min(config.max_speed_mps * step_s, config.largest_surprise_m);
  return (p_m - state.newest_m).norm() <= allowed_m + kNoise_m;
}

// `from_m` is a place that it was at `step_s` before.
void believe(ReflexState& state, const DeviceReading& reading, const Eigen::Vector3d& from_m, double step_s) noexcept {
  state.has_step = step_s > 0.0;
  if (state.has_step) state.step_mps = (reading.p_m - from_m) / step_s;
  state.step_s = step_s;
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
    believe(state, reading, reading.p_m, 0.0);
  } else if (news) {
    const double step_s = state.since_new_s;
    const double jump_m = (reading.p_m - state.believed_m).norm();
    const bool expected = is_expected(config, state, reading.p_m);
    const bool confirmed = state.surprised && is_confirmed(config, state, reading.p_m, step_s);
    const bool jumps = jump_m > config.max_speed_mps * state.since_believed_s + kNoise_m || !(expected || confirmed);
    const bool stands = frozen(config, state, reading, step_s);
    const bool lies = !jumps && contradicts(config, state, reading, reading.p_m - state.newest_m, step_s);
    const bool was_plausible = state.plausible;
    state.plausible = !jumps && !stands && !lies;
    out.returned = state.plausible && !was_plausible;
    // Of a place that was confirmed the speed is that since the reading which it confirms.
    if (!jumps && expected) {
      believe(state, reading, state.believed_m, state.since_believed_s);
    } else if (!jumps) {
      believe(state, reading, state.newest_m, step_s);
    }
    state.surprised = jumps;
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

bool lost_too_much(const ReflexConfig& config, LostTicks& state, double gap_s) noexcept {
  if (gap_s > config.most_lost_s) return true;
  const double counted_s = gap_s > config.long_gap_s ? gap_s : 0.0;
  state.lost_s = std::max(0.0, state.lost_s + counted_s - gap_s / kForgetGaps);
  return state.lost_s > config.most_lost_s;
}

bool was_suspended(SuspendWatch& watch, std::int64_t boot_ns, std::int64_t monotonic_ns, double most_s) noexcept {
  const std::int64_t offset_ns = boot_ns - monotonic_ns;
  const std::int64_t change_ns = watch.begun ? offset_ns - watch.offset_ns : 0;
  watch.begun = true;
  watch.offset_ns = offset_ns;
  return std::abs(static_cast<double>(change_ns)) * 1e-9 >= most_s;
}

}  // namespace asperity
