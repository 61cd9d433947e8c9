#pragma once

#include <string>
#include <string_view>

#include "asperity/image/gray_image.h"

namespace asperity {

// Reads a PGM (netpbm's graymap, P5 binary or P2 text) into levels of 8 or 16 bits: those of a maximum other than 255
// and 65535 are scaled to the next of the two and rounded. Throws Error naming `name` for data that is damaged, cut off
// or followed by more, a level above the maximum, or an image of more than kLargestImageSide_px a side, before the
// memory is taken.
DeepGrayImage parse_pgm(std::string_view data, const std::string& name);

// Reads a binary PGM or PPM (P5, P6) in 8 bit gray: levels are as they are, of 16 bits the upper 8; colours as 0.299 R
// + 0.587 G + 0.114 B. Bytes behind the last pixel are passed over. Throws Error as above.
GrayImage decode_pnm(std::string_view data, const std::string& name);

}  // namespace asperity
