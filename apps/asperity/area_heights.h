#pragma once

#include <string>

#include "asperity/profile/measure_areal_texture.h"

namespace asperity::app {

// An areal map with what is known of its errors.
struct AreaHeights {
  ArealMap map;
  ArealNoise noise;
};

// The heights of an areal texture at its grid's points, nan in its holes. One that `area` made has a standard deviation
// of each height; its errors are smooth as the surface is, and are taken to be correlated over the surface's own
// autocorrelation length (Sal by `config`). Throws Error for a texture that is not areal.
AreaHeights read_area_heights(const std::string& file, const ArealTextureConfig& config);

}  // namespace asperity::app
