#pragma once

#include <vector>

#include "asperity/base/random.h"
#include "asperity/profile/measure_areal_texture.h"

namespace asperity {

// Errors of the heights of `map` as `noise` states them, nan where the map has none. Errors that are correlated are
// white ones through the Gaussian filter whose correlation falls to 0.2 at correlation_m.
std::vector<double> draw_areal_noise(const ArealMap& map, const ArealNoise& noise, Random& random);

// The standard errors of `out`, which is measured from `map` without them.
void take_areal_errors(const ArealMap& map, const ArealTextureConfig& config, const ArealNoise& noise,
                       ArealTextureResult& out);

}  // namespace asperity
