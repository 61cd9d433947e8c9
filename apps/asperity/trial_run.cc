#include "trial_run.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "asperity/base/error.h"
#include "asperity/session/feel_device.h"
#include "asperity/session/feel_scene.h"
#include "asperity/session/interrupt.h"
#include "asperity/session/run_evidence.h"
#include "asperity/session/study_scene.h"

namespace asperity::app {

namespace {

constexpr std::chrono::milliseconds kHold(300);  // without force after another trial was presented
constexpr double kHandGoesOn_s = 600.0;          // of a modelled hand

FeelSettings presented(const Study& study, FeelSettings settings) {
  apply_presentation(study, settings);
  settings.servo.paced = true;
  settings.servo.duration_s = 0.0;
  return settings;
}

FeelDrive drive_of(const Study& study, const DeviceKind& kind, const Scene& scene, FeelSettings settings) {
  if (!kind.driven()) return {};
  settings.servo.duration_s = kHandGoesOn_s;
  const std::array<Eigen::Vector3d, 2> stroke_m = trial_stroke_m(study);
  return make_drive(scene, stroke_m.front(), stroke_m.back(), settings);
}

}  // namespace

TrialRun::TrialRun(const Study& study, const Stimuli& stimuli, const Trial& first, FeelSettings settings)
    : study_(study), stimuli_(stimuli), settings_(presented(study, std::move(settings))) {
  const DeviceKind* kind = find_device_kind(study.presentation.device);
  if (kind == nullptr) throw Error("unknown device '" + study.presentation.device + "'");
  kind_ = *kind;
  drive_ = drive_of(study_, kind_, make_blank_trial_scene(study_), settings_);
  device_ = open_device(study_.presentation.device, drive_, settings_);
  if (const std::string told = device_->fault(); !told.empty()) warnings_.push_back(told);
  // It also puts the middle of the device's workspace into the middle of the scene, which all trials share. The axes of
  // a driven device are the scene's.
  PreparedModel prepared = prepare_render_model(make_trial_scene(study_, stimuli_.textures, first), device_->info(),
                                                kind_.driven(), settings_);
  if (kind_.driven()) settings_.servo.frame = DeviceFrame();
  scene_ = std::make_unique<SnapshotExchange<const RenderModel>>(std::move(prepared.model));
  watch();
  thread_ = std::thread([this] { run(); });
}

TrialRun::~TrialRun() {
  stop_.store(true);
  if (thread_.joinable()) thread_.join();
}

void TrialRun::run() {
  try {
    std::optional<ForceHold> hold;
    if (kind_.has_person) hold.emplace();
    servo_ = run_servo(
        *device_, *scene_, settings_.servo, stop_,
        [this](const ServoTick& tick) {
          statistics_.add(tick);
          started_.store(true);
          if (interrupted()) stop_.store(true);  // whatever the other thread waits for
          if (!counts_.load()) return;
          const std::lock_guard guard(touches_mutex_);
          touches_->add(tick);
        },
        &render_step, &permit_);
    device_->close();
  } catch (...) {
    failure_ = std::current_exception();
    device_->close();
  }
  ended_.store(true);
}

void TrialRun::watch() {
  auto touches = std::make_shared<TileTouches>(tile_of_triangle(study_), study_.presentation.least_force_N);
  counts_.store(false);
  const std::lock_guard guard(touches_mutex_);
  touches_ = std::move(touches);
  kept_ = false;
  felt_s_ = 0.0;
  held_until_ = Clock::now() + kHold;
}

void TrialRun::present(const Trial& trial) {
  permit_.revoke();
  FeelSettings settings = settings_;  // those of the servo thread stay
  PreparedModel prepared = prepare_render_model(make_trial_scene(study_, stimuli_.textures, trial), device_->info(),
                                                kind_.driven(), settings);
  scene_->publish(std::move(prepared.model));
  watch();
}

void TrialRun::keep(bool wanted) {
  const Clock::time_point now = Clock::now();
  const bool given = wanted && now >= held_until_;
  given ? permit_.renew() : permit_.revoke();
  if (given) counts_.store(true);
  if (given && kept_) {
    const double since_s = std::chrono::duration<double>(now - kept_at_).count();
    felt_s_ += std::min(since_s, ForcePermit::kLasts_s);
  }
  kept_ = given;
  kept_at_ = now;
}

void TrialRun::await_start(const std::atomic<bool>& stopped) const {
  while (!started_.load() && !ended_.load() && !stopped.load())
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
}

Verdicts TrialRun::finish() {
  stop_.store(true);
  if (thread_.joinable()) thread_.join();
  if (failure_) std::rethrow_exception(failure_);
  return judge_run(run_evidence(statistics_, servo_, *device_, drive_, *scene_->acquire(), settings_.servo.safety));
}

}  // namespace asperity::app
