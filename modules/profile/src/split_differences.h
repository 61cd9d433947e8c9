#pragma once

#include <span>

#include "asperity/base/nan.h"

namespace asperity {

// What the differences of passes are made of.
struct SplitDifferences {
  double noise_scale = kNan;  // of the stated density of the noise
  double apart_m = 0.0;       // between the lines of two passes, or by what their places are wrong
  double noise_m2 = kNan;     // powers of both in the band, of a pass
  double lines_m2 = kNan;
};

// The density of the differences, D, as D = s N + P (1 − J₀(2πfa)): the stated noise's density N, in whose level there
// is an error, and lines of an isotropic surface of density P that are a apart. s and a by maximum likelihood (Whittle
// 1953: −Σ ln S + D/S over the frequencies), s from 0.1 (errors that passes have in common are not in D) to 2 (the
// stated level is known to a factor of 2), a from 0 to 0.6 mm. What is left of misplaced
// heights has the same shape as small a. Densities at even frequencies (cycles/mm), all of the band.
SplitDifferences split_differences(std::span<const double> frequency, std::span<const double> difference,
                                   std::span<const double> noise, std::span<const double> surface);

}  // namespace asperity
