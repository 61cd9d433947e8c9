#pragma once

#include <cstddef>
#include <span>

#include "asperity/profile/merge_passes.h"
#include "asperity/profile/profile.h"
#include "asperity/profile/texture_noise.h"

namespace asperity {

// A pass of a merge that is a part of a profile: point i of it is point first + i of the profile.
struct PassInProfile {
  std::size_t pass = 0;
  std::size_t first = 0;
};

// Puts the merge in the place of its passes in a profile: each of their points gets the merge's texture at its place
// (MergedPass::on_merge), the pass' own slow heights stay, and over 1 mm from each end of a pass both are blended.
// Gaps stay gaps; passes that are not used stay as they are. `profile` and `noise` are as measured, no noise removed.
// The added noise of the laid points becomes the merge's, point by point and, by their share, in the density and in
// what follows from it; the heights' places stay the profile's. Throws Error if a pass is not within the profile.
void lay_merge(const MergedProfile& merged, std::span<const PassInProfile> passes, Profile& profile,
               TextureNoise& noise);

}  // namespace asperity
