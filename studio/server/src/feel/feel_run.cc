#include "feel/feel_run.h"

#include <utility>

#include "asperity/session/interrupt.h"
#include "feel/tick_stream.h"

namespace asperity::studio {

FeelRun::FeelRun(FeelRunParts parts, Hub& hub, std::uint64_t number, std::function<void(FinishedLog)> log_ended,
                 std::function<void()> ended)
    : parts_(std::move(parts)), scene_(std::move(parts_.model)), log_(std::move(log_ended)), ended_(std::move(ended)) {
  thread_ = std::thread([this, &hub, number] { run(hub, number); });
}

FeelRun::~FeelRun() {
  stop();
  if (thread_.joinable()) thread_.join();
}

void FeelRun::point(const Eigen::Vector3d& p_world_m) noexcept {
  if (parts_.targets) parts_.targets->publish(p_world_m);
}

FeelOutcome FeelRun::take_outcome() {
  if (thread_.joinable()) thread_.join();
  log_.finish();  // of one that began after the thread's last tick
  return std::move(outcome_);
}

void FeelRun::watch(std::shared_ptr<TileTouches> touches) {
  const std::lock_guard guard(watch_mutex_);
  touches_ = std::move(touches);
}

void FeelRun::note_touch(const ServoTick& tick) {
  const std::lock_guard guard(watch_mutex_);
  if (touches_) touches_->add(tick);
}

void FeelRun::run(Hub& hub, std::uint64_t number) {
  try {
    std::optional<ForceHold> hold;
    if (parts_.has_person) hold.emplace();
    TickStream stream(hub, parts_.servo.rate_Hz, number, parts_.blind);
    outcome_.servo = run_servo(
        *parts_.device, scene_, parts_.servo, stop_,
        [&](const ServoTick& tick) {
          outcome_.statistics.add(tick);
          stream.add(tick);
          log_.add(tick);
          note_touch(tick);
        },
        &render_step, &permit_);
    parts_.device->close();
    hold.reset();
    stream.flush();
    outcome_.verdicts = judge_run(run_evidence(outcome_.statistics, outcome_.servo, *parts_.device, parts_.drive,
                                               *scene_.acquire(), parts_.servo.safety));
  } catch (...) {
    outcome_.failure = std::current_exception();
  }
  parts_.device->close();
  log_.finish();
  ended_();
}

}  // namespace asperity::studio
