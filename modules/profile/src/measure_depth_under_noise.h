#pragma once

#include <span>

#include "asperity/profile/find_periodicity.h"
#include "asperity/profile/texture_noise.h"

namespace asperity {

// The depth and its standard error of a pattern of this pitch in heights (m, nan in gaps), without what noise adds to
// the highest less the lowest point of a period (find_periodicity_under_noise.h). Without a whole period the depth is
// nan.
void measure_depth_under_noise(std::span<const double> height_m, double spacing_m, const TextureNoise& noise,
                               Periodicity& out);

}  // namespace asperity
