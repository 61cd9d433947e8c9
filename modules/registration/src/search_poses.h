#pragma once

#include <vector>

#include "asperity/registration/find_registration.h"
#include "coarse_fits.h"
#include "match_rules.h"

namespace asperity::registration {

// An end of the search, and how many of its starts ended there.
struct SearchEnd {
  CentredPose pose;
  int starts = 0;
};

// All poses over the whole mesh: rotations of a spiral times points of the surface, all scored at a few points on a
// grid of distances, the better of them descended there, and the distinct ends, the best first, descended again with
// more points and less width. At most `keep` come back. `use_outward`: the probe's directions rule out poses.
std::vector<SearchEnd> search_poses(const RegistrationSurface& surface, const PointSet& points, bool use_outward,
                                    double facing_cos, const SearchConfig& config, std::size_t keep,
                                    const Observer& observer);

}  // namespace asperity::registration
