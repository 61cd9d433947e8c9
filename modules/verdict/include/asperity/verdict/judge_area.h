#pragma once

#include <cstddef>
#include <limits>

#include "asperity/verdict/verdict.h"

namespace asperity {

// What an areal map shows of itself; nan: not known.
struct AreaEvidence {
  static constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
  bool registered = true;  // the registration that the strokes come from is not invalid
  std::size_t strokes = 0;
  std::size_t ties = 0;         // pairs of strokes that cross or come near
  double agreement = kUnknown;  // part of the strokes' variance that they share where they are tied
  double agreement_sigma = kUnknown;
  double rms_m = kUnknown;    // of the surface that they share
  double noise_m = kUnknown;  // of a stroke, as the scans state it
  double covered = kUnknown;  // part of the patch with heights
  double correlation_mm = kUnknown;
  double held_out_ratio = kUnknown;  // error over σ of strokes that were left out
  double stretch_min = 1.0;          // of the parametrisation
  double stretch_max = 1.0;
};

// The verdicts on an areal map, the worst first.
Verdicts judge_area(const AreaEvidence& evidence);

}  // namespace asperity
