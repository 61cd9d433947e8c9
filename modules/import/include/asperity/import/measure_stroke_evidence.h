#pragma once

#include "asperity/import/stroke.h"
#include "asperity/verdict/judge_stroke.h"

namespace asperity {

// What shows that a stroke is of a surface (judge_stroke): the powers above 40 Hz of windows of 50 ms, 64 samples at
// least (find_stroke_windows). The ratio of the powers' means has the standard error that the windows' scatter gives;
// its chance, that of noise alone, is by the logarithms of the powers:
//
// - where something is quiet, Student's t of the two groups' means, with the scatter of both groups and with that of
// the
//   quiet one, twice the lesser of the two chances (Bonferroni);
// - against a stated noise, the same with the stroke's scatter only;
// - against the quietest tenth of the same windows, by 400 draws of as many powers of Gaussian noise with the
//   recording's own spectrum (χ² with 2 B T degrees of freedom, B = (∫S)²/∫S²).
//
// Windows side by side that are alike count as fewer: by (1 − r)/(1 + r), r their correlation.
//
// The exponent of the speed is a straight line through the logarithms of power and speed (above 2 mm/s, in contact
// where that is known), its standard error from the residuals, as of half as many windows. Limits: a motor, or a hand
// that shakes only while it moves, is a texture to it, unless the hand also moves without contact; noise whose level
// changes over seconds is not noise to it.
StrokeEvidence measure_stroke_evidence(const Stroke& stroke);

}  // namespace asperity
