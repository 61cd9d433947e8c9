#pragma once

#include <cstdint>
#include <limits>
#include <string>

#include "asperity/verdict/verdict.h"

namespace asperity {

// How a run of the servo loop went: numbers, no judgement.
struct RunEvidence {
  std::string device_fault;               // in words; empty: none
  std::uint64_t ticks = 0;                // run
  std::uint64_t ticks_not_finite = 0;     // ramped down: a number was not finite
  std::uint64_t ticks_stale = 0;          // ramped down: no new position
  std::uint64_t ticks_implausible = 0;    // ramped down: a position that no hand can reach
  std::uint64_t ticks_force_limited = 0;  // to max_force_N
  double max_force_N = 0.0;
  std::uint64_t ticks_rate_limited = 0;  // to max_force_rate_N_per_s
  double max_force_rate_N_per_s = 0.0;
  std::uint64_t ticks_unlogged = 0;         // missing in the log
  std::uint64_t ticks_starting_inside = 0;  // no force, since the point began inside an object
  std::uint64_t ticks_touching = 0;
  // Of a known path from any surface; nan: the path is not known.
  double nearest_m = std::numeric_limits<double>::quiet_NaN();
};

// The verdicts on a run, the worst first.
Verdicts judge_run(const RunEvidence& evidence);

// A scan beside what is rendered of it.
struct RenderingEvidence {
  double score = 0.0;  // of 1
  double min_score = 0.0;
  double contact_fraction = 0.0;  // part of the scan's contact in which the renderer was in contact
  double min_contact_fraction = 0.0;
  std::string comparison;  // what was compared, in words with the values
};

// The verdicts on a rendered scan, the worst first.
Verdicts judge_rendering(const RenderingEvidence& evidence);

}  // namespace asperity
