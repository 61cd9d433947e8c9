#pragma once

#include <cstddef>

#include "asperity/recording/recording.h"

namespace asperity {

// Readings of the force sensor at the end of its range. What was pressed harder than that is not known: a force that
// enters a regression is too small there, and nothing in the data shows by how much.
struct ForceLimit {
  std::size_t readings = 0;  // of the force in all
  std::size_t at_limit = 0;  // of these
  double limit_N = 0.0;      // largest magnitude of a limited channel, by the calibration; with at_limit > 0

  double share() const { return readings == 0 ? 0.0 : static_cast<double>(at_limit) / static_cast<double>(readings); }
  // Compliance, stiffness and friction are not determined, and the verdict `force_clipped` states why. Impacts that are
  // cut off for less than that move a mean of a fifth of the limit by 5 % if they were twice as strong as the limit: no
  // more than the standard errors of these estimates.
  bool is_limited() const { return at_limit >= kFewest && share() >= kLeast_share; }

  static constexpr std::size_t kFewest = 5;
  static constexpr double kLeast_share = 0.01;
};

// A reading is at the end of the range, on either side of no load but not near it, if
// - it is at the end of the converter's range that the recording states (adc_min, adc_max), and no reading lies beyond
//   that range: it is the inertial sensors', and the force may have a converter of its own,
// - or it is in a plateau: the outermost value (but for four single spikes) has at least 8 times as many readings as
// the
//   value next to it, and at least 8 times as many as the usual run of equal readings is long. A smooth peak that is
//   rounded to counts is at its highest count for at most 1/(√2 − 1) = 2.4 times as long as at the next lower one; a
//   signal that is cut off is there for all the time above. Readings that are held between two conversions make all
//   runs longer alike.
// A sensor that is too coarse to resolve a steady force has such a plateau as well; it does not show how the force
// varied either. Of a sensor with three axes each channel is examined. A recording whose force never changes has none.
ForceLimit find_force_limit(const Recording& recording);

}  // namespace asperity
