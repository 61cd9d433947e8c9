#pragma once

#include <string>

#include "asperity/texture/height_map.h"

namespace asperity {

// The map's levels as a PNG of gray (png_image.h). Throws Error for a map that is empty, of more than
// kLargestImageSide_px a side, or has other than columns·rows levels of `bits` bits.
std::string format_height_image(const HeightMap& map);

}  // namespace asperity
