#include "servo_core.h"

#include <algorithm>
#include <cmath>

#include "asperity/base/host_clock.h"

namespace asperity {
namespace {

constexpr double kRecorded_s = 2.0;

}  // namespace

std::int64_t due_ns(std::uint64_t k, double rate_Hz) noexcept {
  return std::llround(static_cast<double>(k) * 1e9 / rate_Hz);
}

ServoCore::ServoCore(HapticDevice& device, SnapshotExchange<const RenderModel>& scene, const ServoConfig& config,
                     ServoStep step, const ForcePermit* permit)
    : device_(device),
      scene_(scene),
      config_(config),
      safety_config_(lower_to_device(config.safety, device.info())),
      step_(step),
      permit_(permit),
      duration_ticks_(static_cast<std::uint64_t>(std::llround(config.duration_s * config.rate_Hz))),
      reflexes_(config.reflexes),
      judged_(!device.info().simulated),
      recorder_(static_cast<std::size_t>(std::ceil(kRecorded_s * config.rate_Hz))) {
  // Not >: a device that states none has nan.
  if (device.info().max_speed_mps < reflexes_.max_speed_mps) reflexes_.max_speed_mps = device.info().max_speed_mps;
}

void ServoCore::begin_ending(ServoEnd end) noexcept {
  if (ending_) return;
  ending_ = true;
  end_ = end;
}

void ServoCore::judge(const DeviceReading& reading, double dt_s, bool suspended) noexcept {
  if (!judged_ || fault_ != ReflexFault::kNone) return;
  const ReadingJudgement judgement = check_reading(reflexes_, reflex_, reading, dt_s);
  plausible_ = judgement.plausible;
  // What the renderer remembers is of a place where the hand is not: it begins outside of everything again.
  if (judgement.returned) servo_ = {};
  if (judgement.fault) fault_ = ReflexFault::kImplausible;
  if (lost_too_much(reflexes_, lost_, dt_s)) fault_ = ReflexFault::kLostTicks;
  if (suspended) fault_ = ReflexFault::kSuspended;
}

SafeForce ServoCore::make_safe_now(SafetyInput input) noexcept {
  SafetyConfig config = safety_config_;
  if (permit_ != nullptr) {
    input.permitted = is_permitted(permit_watch_, *permit_, input.dt_s);
    config.max_force_N = std::min(config.max_force_N, permit_->max_force_N());
  }
  return make_safe(config, safety_, input);
}

ServoOutput ServoCore::render(const DeviceReading& reading, const Eigen::Vector3d& v_device_mps, double dt_s,
                              ServoTick& tick) noexcept {
  const RenderModel* const model = scene_.acquire();
  scene_changed_ = model_ != nullptr && model != model_;
  model_ = model;
  // A position that is no number must not reach what the renderer remembers.
  if (!reading.p_m.allFinite() || !v_device_mps.allFinite()) return {};
  DeviceState state;
  state.p_world_m = tick.p_world_m;
  state.v_world_mps = config_.frame.velocity_mps(v_device_mps);
  state.dt_s = dt_s;
  const std::int64_t begin_ns = config_.timed ? host_now_ns() : 0;
  ServoOutput output = step_(*model, servo_, state);
  if (config_.timed) {
    tick.step_ns = host_now_ns() - begin_ns;
    step_time_.add(tick.step_ns);
  }
  return output;
}

bool ServoCore::tick(std::uint64_t k, std::uint64_t ticks_since, std::int64_t late_ns, bool stop_asked, TickSink& sink,
                     bool suspended) {
  if (stop_asked) begin_ending(ServoEnd::kStopped);
  if (duration_ticks_ > 0 && k >= duration_ticks_) begin_ending(ServoEnd::kDuration);
  if (ending_ && is_at_rest(safety_)) return false;

  ServoTick tick;
  tick.t_ns = due_ns(k, config_.rate_Hz);
  tick.late_ns = late_ns;
  tick.reading = device_.read(tick.t_ns);
  if (tick.reading.status == DeviceStatus::kEnded) {
    if (!ending_) end_ = ServoEnd::kDeviceEnded;
    device_.write(Eigen::Vector3d::Zero());
    return false;
  }
  const double dt_s = static_cast<double>(ticks_since) / config_.rate_Hz;
  judge(tick.reading, dt_s, suspended);
  if (fault_ != ReflexFault::kNone) tick.reading.status = DeviceStatus::kFault;
  Eigen::Vector3d v_device_mps = tick.reading.v_mps;
  const Eigen::Vector3d estimated_mps =
      estimate_velocity(velocity_, tick.reading.p_m, tick.reading.sequence, 1e-9 * static_cast<double>(tick.t_ns),
                        config_.velocity_noise_m);
  if (!v_device_mps.allFinite()) v_device_mps = estimated_mps;
  tick.p_world_m = config_.frame.position_m(tick.reading.p_m);
  if (tick.reading.status != DeviceStatus::kFault && plausible_)
    tick.output = render(tick.reading, v_device_mps, dt_s, tick);

  SafetyInput input;
  input.force_N = tick.output.force_N;
  input.spring_N = tick.output.contact_N + tick.output.friction_N;
  input.stretch_m = (tick.output.proxy_m - tick.p_world_m) / config_.frame.scale;
  input.hand_m = config_.frame.R_world_device * tick.reading.p_m;
  input.hand_mps = config_.frame.R_world_device * v_device_mps;
  input.sequence = tick.reading.sequence;
  input.status = tick.reading.status;
  input.plausible = plausible_;
  input.scene_changed = scene_changed_;
  input.ending = ending_;
  input.dt_s = dt_s;
  input.tick_s = 1.0 / config_.rate_Hz;
  const SafeForce safe = make_safe_now(input);
  device_.write(config_.frame.device_force_N(safe.force_N));

  tick.out_world_N = safe.force_N;
  tick.limited_by = safe.limited_by;
  tick.gain = safe.gain;
  ++statistics_.ticks;
  if (tick.out_world_N != tick.output.force_N) ++statistics_.limited_ticks;
  statistics_.dissipated_J += safe.dissipated_J;
  late_.add(late_ns);
  recorder_.push(tick);
  if (!sink.take(tick)) ++statistics_.lost_ticks;
  if (tick.reading.status == DeviceStatus::kFault) {
    end_ = ServoEnd::kFault;
    return false;
  }
  return true;
}

ServoResult ServoCore::take_result() {
  const auto seconds = [](std::int64_t duration_ns) { return 1e-9 * static_cast<double>(duration_ns); };
  ServoResult result;
  result.end = end_;
  result.fault = fault_;
  result.statistics = statistics_;
  result.statistics.late_p50_s = seconds(late_.percentile_ns(0.5));
  result.statistics.late_p99_s = seconds(late_.percentile_ns(0.99));
  result.statistics.late_max_s = seconds(late_.max_ns());
  result.statistics.step_p50_s = seconds(step_time_.percentile_ns(0.5));
  result.statistics.step_p99_s = seconds(step_time_.percentile_ns(0.99));
  result.statistics.step_max_s = seconds(step_time_.max_ns());
  result.last_ticks = recorder_.take();
  return result;
}

}  // namespace asperity
