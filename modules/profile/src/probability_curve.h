#pragma once

#include <optional>

#include "material_curve.h"

namespace asperity {

// A material ratio curve on probability paper, where Gaussian heights are a straight line: of plateaus over pits two
// lines (ISO 13565-3).
struct ProbabilityCurve {
  double plateau = 0.0;  // fall of the upper line a standard deviation
  double pits = 0.0;     // of the lower one
  double ratio = 0.0;    // where they meet
};

// The broken line of least squares, the heights at even distances from −3 to 3 standard deviations (less where there
// are too few). nullopt for a surface that is not of two processes: the lower line is not 1.5 times as steep as the
// upper one, or the broken line leaves more than a hundredth of the heights' variance (our limits).
std::optional<ProbabilityCurve> fit_probability_curve(const MaterialCurve& curve);

}  // namespace asperity
