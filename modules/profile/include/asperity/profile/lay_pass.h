#pragma once

#include <vector>

#include "asperity/profile/align_passes.h"
#include "asperity/profile/profile_pass.h"

namespace asperity {

// Where the points of `reference` are in `pass`: indices of its heights, with fractions, one a point of `reference`;
// they fall where the pass was travelled the other way. nan where the reference has no heights, and beyond the first
// or last height of the pass. Shift and stretch are those of `alignment`; where it agrees, a piecewise linear rest
// follows by maximum likelihood, with knots every `config.knot_spacing_m` that have the standard deviation of both
// places (docs/merge.md). Without agreement the rest would fit noise and is 0; so it is where the places run away.
// Throws Error as align_passes() does.
std::vector<double> lay_pass(const ProfilePass& reference, const ProfilePass& pass, const PassAlignment& alignment,
                             const AlignPassesConfig& config);

}  // namespace asperity
