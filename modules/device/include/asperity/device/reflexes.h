#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <string_view>

#include <Eigen/Core>

#include "asperity/device/haptic_device.h"

namespace asperity {

// What a reading of a device that pushes a hand may look like. A computed hand is not judged.
struct ReflexConfig {
  double max_speed_mps = 5.0;            // no hand at a device is faster; a device's own limit lowers it
  double max_acceleration_mps2 = 500.0;  // beyond where it was heading a place must be confirmed by the next reading
  double largest_surprise_m = 0.005;     //   and always by so much, however long ago the last one was
  double frozen_after_s = 0.05;          // new readings of the same place, bit for bit, for so long
  double frozen_speed_mps = 0.02;        //   while they state at least this speed
  double contradicts_mps = 1.0;  // between stated velocity and steps, mean of about 20 ms, and half the speed more
  double fault_after_s = 0.025;  // of implausible readings, less the plausible time / 20 since
  double most_lost_s = 0.15;  // of the loop's schedule, in gaps of more than long_gap_s, less a tenth of the time since
  double long_gap_s = 0.01;
  double most_suspended_s = 0.01;  // of the machine

  template <class V>
  void visit(V& v) {
    v.field("max_speed_mps", max_speed_mps, "a position that jumps faster is not believed", {0.1, 100.0});
    v.field("max_acceleration_mps2", max_acceleration_mps2,
            "a position farther from where it was heading than this allows is believed when the next one confirms it",
            {1.0, 1e6});
    v.field("largest_surprise_m", largest_surprise_m, "the same, by this distance, however long ago the last one was",
            {1e-4, 1.0});
    v.field("frozen_after_s", frozen_after_s, "the same position, bit for bit, for so long is not believed",
            {0.005, 10.0});
    v.field("frozen_speed_mps", frozen_speed_mps, "if its velocity is at least this", {0.0, 10.0});
    v.field("contradicts_mps", contradicts_mps, "a velocity that differs by so much from the steps is not believed",
            {0.05, 100.0});
    v.field("fault_after_s", fault_after_s, "readings that are not believed for so long are a fault", {0.001, 10.0});
    v.field("most_lost_s", most_lost_s, "a loop that was not run for so long, at once or in long gaps, is a fault",
            {0.01, 10.0});
    v.field("long_gap_s", long_gap_s, "shorter gaps between two ticks do not count", {0.001, 1.0});
    v.field("most_suspended_s", most_suspended_s, "a machine that was suspended for so long is a fault", {0.001, 10.0});
  }
};

// Why the loop itself ended a run.
enum class ReflexFault : std::uint8_t { kNone, kImplausible, kLostTicks, kSuspended };
inline constexpr std::array<std::string_view, 4> kReflexFaultWords{
    "", "its positions jump, stop changing during motion, or contradict its velocity",
    "the servo loop was not run for too long", "the machine was suspended"};

// What check_reading remembers. Begin with ReflexState{}.
struct ReflexState {
  bool heard = false;
  std::uint64_t sequence = 0;                            // of the last reading that was new
  Eigen::Vector3d believed_m = Eigen::Vector3d::Zero();  // the last plausible place
  double since_believed_s = 0.0;
  bool has_step = false;                               // of the next two: not before two plausible places
  Eigen::Vector3d step_mps = Eigen::Vector3d::Zero();  // from the plausible place before to that one
  double step_s = 0.0;
  bool surprised = false;                              // the last new reading was not where it was heading
  Eigen::Vector3d newest_m = Eigen::Vector3d::Zero();  // the last new reading's, plausible or not
  double since_new_s = 0.0;
  double frozen_s = 0.0;
  Eigen::Vector3d contradiction_mps = Eigen::Vector3d::Zero();  // steps less stated velocity, mean of about 20 ms
  double distrust_s = 0.0;
  bool plausible = true;  // the last judgement
};

struct ReadingJudgement {
  bool plausible = true;  // may be rendered
  bool returned = false;  // plausible again: begin softly, from nothing remembered
  bool fault = false;     // implausible for too long, or too often
};

// One tick: whether the place that the device states can be that of a hand. Not plausible is a new reading
// (a) farther from the last plausible one than max_speed_mps allows in the time between (and 0.2 mm),
// (b) farther than max_acceleration_mps2 allows, and at most largest_surprise_m (and 0.4 mm), from where the last two
//     plausible ones were heading: until the next reading is near it, or is where it was heading,
// (c) the same bit for bit for frozen_after_s while its velocity is at least frozen_speed_mps,
// (d) whose velocity contradicts its steps;
// and every tick until there is a plausible one. A place that stays after a jump is plausible as soon as a hand could
// have come there. Readings that are not finite are not judged here. Realtime-safe: yes.
ReadingJudgement check_reading(const ReflexConfig& config, ReflexState& state, const DeviceReading& reading,
                               double dt_s) noexcept;

// What lost_too_much remembers. Begin with LostTicks{}.
struct LostTicks {
  double lost_s = 0.0;
};
// One tick, `gap_s` after the one before: true if the loop was not run for most_lost_s at once, or in gaps of more than
// long_gap_s whose sum, less a tenth of the time since, is that. Realtime-safe: yes.
bool lost_too_much(const ReflexConfig& config, LostTicks& state, double gap_s) noexcept;

// CLOCK_BOOTTIME less CLOCK_MONOTONIC grows while the machine is suspended. Begin with SuspendWatch{}.
struct SuspendWatch {
  bool begun = false;
  std::int64_t offset_ns = 0;
};
// True if the machine was suspended for `most_s` since the call before, or one of the clocks stepped by that.
// Realtime-safe: yes.
bool was_suspended(SuspendWatch& watch, std::int64_t boot_ns, std::int64_t monotonic_ns, double most_s) noexcept;

}  // namespace asperity
