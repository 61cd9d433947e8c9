#pragma once

#include <span>
#include <vector>

#include "asperity/base/problem.h"
#include "refinement.h"

namespace asperity::registration {

// The settings with knots far enough apart that there are not too many.
RefineConfig with_few_knots(std::span<const MeasuredPath> paths, RefineConfig config, Problems& problems);

// The paths' filters from the heights at a pose.
std::vector<Whitening> learn_whitenings(const PathChain& chain, const FacetHeights& heights,
                                        const RefineConfig& config);

// Of the motions that a registration lists as undetermined, those of which the paths say less than a guess.
std::vector<UndeterminedMotion> held_motions(const RegistrationResult& start);
// Their covariance: they are known as well as a guess is.
Matrix6 held_covariance(std::span<const UndeterminedMotion> held, double guess_sigma_m);

}  // namespace asperity::registration
