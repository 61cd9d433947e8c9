#pragma once

#include <optional>

#include "asperity/study/staircase.h"

namespace asperity {

// The standard error of ln(threshold) of a track, `level` being its staircase_threshold(). Reversals follow one another
// too closely for their scatter to tell it; it is the scatter of thresholds over simulated tracks by the same rule
// (parametric bootstrap, Wichmann and Hill 2001), of an observer of two alternatives with Weibull's psychometric
// function who has the threshold `level` and the slope that the track's answers make likely. The seed is fixed. Nothing
// if most of the simulated tracks have no threshold.
std::optional<double> staircase_error_ln(const StaircaseTrack& track, double level, const StaircaseConfig& config);

}  // namespace asperity
