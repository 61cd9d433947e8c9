#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <utility>

#include "asperity/image/gray_image.h"

namespace asperity {

// The image in a PNG, JPEG or PGM/PPM file, in gray, 8 bit; a camera's note of how it was held is ignored, so that
// pixels stay where the lens put them. Throws Error naming the file if it is none of these, damaged, cut off, or
// wider or higher than kLargestImageSide_px, which is seen before memory is taken.
GrayImage read_gray_image(const std::filesystem::path& path);

// The same from memory; `name` is what messages call it.
GrayImage decode_gray_image(std::span<const unsigned char> bytes, const std::string& name);

// Width and height as the file's own header gives them, without decoding. Throws Error as above.
std::pair<int, int> encoded_image_size(std::span<const unsigned char> bytes, const std::string& name);

}  // namespace asperity
