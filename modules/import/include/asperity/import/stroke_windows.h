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

// Active: faster than 10 mm/s where the speed is measured, and at least the stroke's contact_N where the force is; all
// windows if neither is. Quiet: slower than 2 mm/s and 0.1 s away from any motion; without a quarter of a second of
// that, below half of contact_N and 0.1 s away from any contact; if neither speed nor force is measured, the tenth of
// the windows with the least power, a quarter of a second at least, and the louder half is active.
StrokeWindows find_stroke_windows(const Stroke& stroke, std::span<const double> acceleration_mps2, double window_s);

// What shows that a stroke is of a surface (judge_stroke): the powers above 40 Hz of windows of 50 ms, 64 samples at
// least. The powers' means have the standard errors that the windows' scatter gives, their ratio's follows by
// propagation. The exponent of the speed is a straight line through the logarithms of power and speed (above 2 mm/s, in
// contact where that is known), its standard error from the residuals, by √2 larger since windows side by side are
// alike. Limits: a motor, or a hand that shakes only while it moves, is a texture to it.
StrokeEvidence measure_stroke_evidence(const Stroke& stroke);

}  // namespace asperity
