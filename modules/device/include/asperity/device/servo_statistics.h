#pragma once

#include <cstdint>

namespace asperity {

// How well the loop kept its schedule. Times of the ticks' starts after they were due.
struct ServoStatistics {
  std::uint64_t ticks = 0;
  std::uint64_t overruns = 0;    // ticks that were not done when the next was due
  std::uint64_t skipped = 0;     // due times that passed without a tick
  std::uint64_t lost_ticks = 0;  // not delivered to on_tick: the queue was full
  double late_p50_s = 0.0;
  double late_p99_s = 0.0;
  double late_max_s = 0.0;
  double step_p50_s = 0.0;  // of the render step, if timed
  double step_p99_s = 0.0;
  double step_max_s = 0.0;
  double dissipated_J = 0.0;        // by the passivity controller
  std::uint64_t limited_ticks = 0;  // on which the safety layer changed the force
  bool real_time = false;           // priority was granted
  bool memory_locked = false;       // no page of the process can be swapped out
  int memory_error = 0;             // errno where that was asked for and refused
};

}  // namespace asperity
