#pragma once

#include "asperity/texture/height_and_gradient.h"
#include "asperity/texture/height_map.h"

namespace asperity {

// h and its gradient at (x_m, y_m): bicubic convolution (Keys 1981, a = −1/2) of sixteen pixels, which passes
// through every pixel and is C¹ everywhere, seams of a tiling image included. Border as with SplineGrid. Does not
// allocate. Realtime-safe: yes, thread-safe: yes. nan for a position that is not finite or an empty map.
HeightAndGradient evaluate_height(const HeightMap& map, double x_m, double y_m) noexcept;

double lowest_height_m(const HeightMap& map);

}  // namespace asperity
