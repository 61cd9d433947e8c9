#pragma once

#include <array>
#include <atomic>
#include <chrono>
#include <exception>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "asperity/device/device_registry.h"
#include "asperity/device/force_permit.h"
#include "asperity/device/servo_loop.h"
#include "asperity/device/snapshot_exchange.h"
#include "asperity/session/feel_drive.h"
#include "asperity/session/feel_report.h"
#include "asperity/session/feel_settings.h"
#include "asperity/session/study_stimuli.h"
#include "asperity/session/tile_touches.h"
#include "asperity/study/study.h"
#include "asperity/study/trial.h"
#include "asperity/verdict/verdict.h"

namespace asperity::app {

// A device on which the trials of a study are rendered, one after another: run_servo on a thread of its own. The force
// is there only while keep() is called, at least every 0.25 s (force_permit.h), and not for 0.3 s after another trial
// was presented. Functions are for one thread.
class TrialRun {
 public:
  // Opens the device of `study` with the first trial, without force. Throws Error in words for a device that is not
  // there.
  TrialRun(const Study& study, const Stimuli& stimuli, const Trial& first, FeelSettings settings);
  // Stops it, and waits for its end: the safety layer's ramp.
  ~TrialRun();
  TrialRun(const TrialRun&) = delete;
  TrialRun& operator=(const TrialRun&) = delete;

  // Another trial: the force goes to zero, and what was touched begins anew.
  void present(const Trial& trial);
  // Keeps the force for a moment, or with `wanted` false lets it go to zero.
  void keep(bool wanted);
  // For how long the trial could be touched, s; and how its tiles were.
  double felt_s() const { return felt_s_; }
  std::array<TileTouch, 2> touches() const { return touches_->touches(); }

  // Waits for the first tick, the end, or `stopped`.
  void await_start(const std::atomic<bool>& stopped) const;
  // The device has ended, or has a fault.
  bool has_ended() const { return ended_.load(); }
  // Stops it; why it ended, and what is to be said of that. Throws what the loop threw.
  Verdicts finish();
  // What the device says of itself. What the renderer says of a trial's scene would tell its textures apart.
  const std::vector<std::string>& warnings() const { return warnings_; }

 private:
  using Clock = std::chrono::steady_clock;

  void run();
  void watch();

  const Study study_;
  const Stimuli& stimuli_;
  FeelSettings settings_;
  DeviceKind kind_;
  FeelDrive drive_;
  std::unique_ptr<HapticDevice> device_;
  std::unique_ptr<SnapshotExchange<const RenderModel>> scene_;
  ForcePermit permit_;
  std::atomic<bool> stop_{false}, ended_{false}, started_{false};
  std::atomic<bool> counts_{false};  // touches of this trial: none of the ramp of the one before
  std::mutex touches_mutex_;
  std::shared_ptr<TileTouches> touches_;
  Clock::time_point held_until_, kept_at_;
  bool kept_ = false;
  double felt_s_ = 0.0;
  std::vector<std::string> warnings_;
  FeelStatistics statistics_;
  ServoResult servo_;
  std::exception_ptr failure_;
  std::thread thread_;
};

}  // namespace asperity::app
