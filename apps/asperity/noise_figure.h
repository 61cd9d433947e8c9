#pragma once

#include <string>

#include "asperity/calibration/tracker_noise.h"

namespace asperity::app {

// Histograms of the position's deviations at rest along x, y and z with the Gaussians of their standard deviations
// (seed Fig. 9), as an SVG drawing of 900 by 320 px.
std::string noise_svg(const StaticInterval& rest);

inline constexpr const char* kNoiseSvgBegin =
    "<svg xmlns=\"http://www.w3.org/2000/svg\" data-asperity=\"tracker-noise\"";

}  // namespace asperity::app
