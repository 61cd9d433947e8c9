#pragma once

#include "asperity/tracking/tag_pattern.h"

namespace asperity {

// A tag's picture spread by a Gaussian, at a place in cells from its top left.
struct BlurredValue {
  double value = 0.0;  // 0 black to 1 white
  double by_u = 0.0, by_v = 0.0;
  double by_sigma_u = 0.0, by_sigma_v = 0.0, by_covariance = 0.0;
};

// Standard deviations in cells along the picture's columns and rows, and the spread's covariance between the two: that
// of a Gaussian which the tag's tilt has slanted. The cells at the picture's border go on for ever. A Gaussian solves
// the heat equation, so that covariance c adds exp(c ∂u ∂v) to what is separable in u and v; it is taken to the second
// order (within 0.6 % of the contrast at a correlation of 0.6, at corners of cells only; edges are exact).
// `by_u` and `by_v` leave the covariance's part out.
BlurredValue blurred_pattern(const TagPattern& pattern, double u, double v, double sigma_u, double sigma_v,
                             double covariance = 0.0);

}  // namespace asperity
