#pragma once

#include <string>

#include "asperity/plot/drawing.h"

namespace asperity {

// The drawing as SVG 1.1; pixels are embedded as a PNG.
std::string format_svg(const Drawing& drawing);

}  // namespace asperity
