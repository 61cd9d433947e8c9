#pragma once

#include "asperity/plot/figure.h"
#include "roughness_settings.h"

namespace asperity::app {

// P, R and W over the path, the material ratio of R, and the spectrum of P.
Figure profile_figure(const HeightProfile& profile, const RoughnessConfig& config);

// The surface that the parameters are of, and its material ratio.
Figure map_figure(const ArealMap& map, const ArealTextureConfig& config);

}  // namespace asperity::app
