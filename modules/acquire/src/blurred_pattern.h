#pragma once

#include "asperity/acquire/tag_pattern.h"

namespace asperity {

// A tag's picture spread by a Gaussian, at a place in cells from its top left.
struct BlurredValue {
  double value = 0.0;  // 0 black to 1 white
  double by_u = 0.0, by_v = 0.0;
  double by_sigma_u = 0.0, by_sigma_v = 0.0;
};

// Standard deviations in cells along the picture's columns and rows. The cells at the picture's border go on for ever.
// What a slanted spread does to the corners of cells is left out: edges are exact.
BlurredValue blurred_pattern(const TagPattern& pattern, double u, double v, double sigma_u, double sigma_v);

}  // namespace asperity
