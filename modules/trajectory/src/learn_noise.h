#pragma once

#include "asperity/trajectory/estimate_trajectory_fused.h"
#include "inertial_smoother.h"

namespace asperity::inertial_smoother {

// The factors to begin with: larger than stated where a first pass would otherwise refuse good poses.
Factors first_factors(bool has_gyro, const FusedConfig& config);

// Where most poses lie farther from the smoothed path than their noise allows, the stated σ is too small, and weights
// by it would leave too few to learn from: scales it, and the normalised squares with it, by the middle one.
void widen_tracker(const Problem& problem, const FusedConfig& config, Smoothed& smoothed, Factors& factors);

// One step towards the factors under which the recording is likeliest (Zhou and others, MM algorithms for variance
// components models, J. Comp. Graph. Stat. 28, 2019): θᵢ ← θᵢ (seenᵢ / expectedᵢ)^½, with a prior of some observations.
void improve_factors(const NoiseScore& score, const FusedConfig& config, bool has_gyro, Factors& factors);

}  // namespace asperity::inertial_smoother
