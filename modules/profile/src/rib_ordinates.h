#pragma once

#include <optional>
#include <span>

#include "passed_windows.h"

namespace asperity {

// Whether straight ribs can be waves of unequal length along the path: it bends by more than 1/50 of its length, or is
// more a loop than a stroke. Not of a path of which nothing is known.
bool bends_over_ribs(std::span<const Eigen::Vector2d> unrolled_m, double spacing_m);

// The highest ordinate, 2 |Σ w h e^(−2πi k u)|² / (Σ w)² as a mean over the windows (m²), that straight ribs of any
// direction have over the path where they make `frequency_Hz` at the profile's speeds. u is the coordinate across the
// ribs; a direction that the path crosses at less than 0.3 of its speed (median) is left out. Along a circle or a bend
// the waves of ribs grow longer as they are crossed at a slant, and only over u they are a line. Empty where the path
// is so long, and the waves so short, that a thousand million terms would have to be summed.
std::optional<double> highest_of_ribs(const PassedWindows& passed, double frequency_Hz);

}  // namespace asperity
