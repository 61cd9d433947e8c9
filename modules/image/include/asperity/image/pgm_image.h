#pragma once

#include <string>
#include <string_view>

#include "asperity/image/png_image.h"

namespace asperity {

// Reads a PGM (netpbm's greymap, P5 binary or P2 text) into levels of 8 or 16 bits: those of a maximum other than 255
// and 65535 are scaled to the next of the two and rounded. Throws Error naming `name` for data that is damaged, cut off
// or followed by more, a level above the maximum, or an image larger than png_image.h allows, before the memory is
// taken.
GreyImage parse_pgm(std::string_view data, const std::string& name);

}  // namespace asperity
