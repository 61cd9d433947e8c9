#pragma once

#include <span>
#include <string>

#include "asperity/image/gray_image.h"

namespace asperity {

// Reads a JPEG's luma. Frames of Motion-JPEG, which lack the usual Huffman tables, are read too. `name` is what
// messages call it. Throws Error naming it for data that is damaged or cut off, for an image of four colours (CMYK),
// and for more than kLargestImageSide_px a side, before memory is taken; at most 512 MB are taken in all.
GrayImage decode_jpeg(std::span<const unsigned char> bytes, const std::string& name);

}  // namespace asperity
