#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "asperity/import/stroke.h"
#include "asperity/verdict/judge_stroke.h"

namespace asperity {

// Windows of one length, by their first samples, that do not overlap.
struct StrokeWindows {
  std::size_t length = 0;
  std::vector<std::size_t> active;  // in motion and contact, as far as they are known
  std::vector<std::size_t> quiet;
  StrokeQuiet quiet_is = StrokeQuiet::kNone;
};

// The samples at which the tip touches: the force's mean over 50 ms is at least the stroke's contact_N for 0.25 s on
// end, which the inertia and the weight of a tip that a hand shakes in the air do not reach. All samples without a
// force.
std::vector<char> contact_samples(const Stroke& stroke);

// Those in contact and, where the speed is measured, faster than `speed_mps`.
std::vector<char> active_samples(const Stroke& stroke, double speed_mps);

// The first samples of whole windows in which all samples are marked.
std::vector<std::size_t> marked_windows(const std::vector<char>& marked, std::size_t length);

// Active: faster than 10 mm/s where the speed is measured, and in contact where the force is; all windows if neither
// is. Quiet, what there is a quarter of a second of, in this order: faster than 10 mm/s, with a force below half of
// contact_N and 0.05 s away from any other (the same hand, without the surface); slower than 2 mm/s and 0.1 s away from
// any motion; below that force at any speed. If neither speed nor force is measured, the tenth of the windows with the
// least power, a quarter of a second at least, and the louder half is active.
StrokeWindows find_stroke_windows(const Stroke& stroke, std::span<const double> acceleration_mps2, double window_s);

}  // namespace asperity
