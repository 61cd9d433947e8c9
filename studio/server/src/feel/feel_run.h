#pragma once

#include <atomic>
#include <exception>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "asperity/device/force_permit.h"
#include "asperity/device/pointer_device.h"
#include "asperity/device/servo_loop.h"
#include "asperity/device/snapshot_exchange.h"
#include "asperity/session/feel_report.h"
#include "asperity/session/run_evidence.h"
#include "asperity/session/tile_touches.h"
#include "asperity/studio/hub.h"
#include "feel/run_log.h"

namespace asperity::studio {

// What a run is made of.
struct FeelRunParts {
  std::unique_ptr<HapticDevice> device;
  std::unique_ptr<const RenderModel> model;
  ServoConfig servo;
  std::shared_ptr<PointerTargets> targets;  // of the mouse, else null
  FeelDrive drive;                          // what moves the point, if no hand does
  bool blind = false;                       // browsers see where the point is and what is let through, no more
  bool has_person = false;                  // a hand is at it: a signal does not end the program before it is free
};

// How a run ended.
struct FeelOutcome {
  ServoResult servo;
  FeelStatistics statistics;
  Verdicts verdicts;
  std::exception_ptr failure;  // what the loop or the log threw, with zero force
};

// A scene being rendered: run_servo on threads of its own, which no browser and no page can delay. Functions are for
// the studio's thread and never wait for the servo. Forces are there only while the permit is renewed.
class FeelRun {
 public:
  // Begins at once. On the run's thread are called: `log_ended` for each log, and last `ended`, when the force is zero
  // and the device closed.
  FeelRun(FeelRunParts parts, Hub& hub, std::uint64_t number, std::function<void(FinishedLog)> log_ended,
          std::function<void()> ended);
  // Stops it, and waits for its end: the safety layer's ramp.
  ~FeelRun();
  FeelRun(const FeelRun&) = delete;
  FeelRun& operator=(const FeelRun&) = delete;

  ForcePermit& permit() { return permit_; }
  void stop() noexcept { stop_.store(true); }
  // Another scene, while it is touched.
  void swap(std::unique_ptr<const RenderModel> model) { scene_.publish(std::move(model)); }
  // What hears of the ticks from now on; may be null.
  void watch(std::shared_ptr<TileTouches> touches);
  // The target of the device point by the pointer; nothing for a device that a hand or a path moves.
  void point(const Eigen::Vector3d& p_world_m) noexcept;

  RunLog& log() { return log_; }

  // After `ended`: waits for the thread's last steps.
  FeelOutcome take_outcome();

 private:
  void run(Hub& hub, std::uint64_t number);
  void note_touch(const ServoTick& tick);

  FeelRunParts parts_;
  SnapshotExchange<const RenderModel> scene_;
  ForcePermit permit_;
  std::atomic<bool> stop_{false};
  RunLog log_;
  std::mutex watch_mutex_;
  std::shared_ptr<TileTouches> touches_;
  FeelOutcome outcome_;
  std::function<void()> ended_;
  std::thread thread_;
};

}  // namespace asperity::studio
