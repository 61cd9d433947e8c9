#pragma once

#include <cstdint>

namespace fake {

// What a test that runs the program sees of the fake driver's controller, and does to it: a file that both have mapped,
// named by FAKE_DHD_CONTROLLER. The controller turns its motors off as the maker states: when no force has come for the
// watchdog's time (steps of 125 µs; 0: never).
struct Controller {
  enum Trouble : std::int32_t { kNone, kHangs, kUnplugged, kGlitch, kGarbage };

  double force_N[3];
  std::int64_t set_at_ns;  // CLOCK_MONOTONIC
  std::int32_t watchdog_steps, enabled;
  std::int32_t trouble;
};

}  // namespace fake
