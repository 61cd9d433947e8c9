#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "asperity/image/gray_image.h"

namespace asperity {

// Reads a PNG of 8 or 16 bit gray without an alpha channel, as its samples are: no gamma, no scaling.
// Anything else is refused. `name` is what messages call it. Throws Error naming it for data that is
// damaged or cut off, for more than kLargestImageSide_px a side, all before the memory is taken.
DeepGrayImage parse_png(std::string_view data, const std::string& name);

// Reads any PNG in gray of 8 or 16 bits: levels of 1, 2 and 4 bits are spread over 8 (v · 255 / highest), colours and
// palettes become 0.299 R + 0.587 G + 0.114 B, transparency is left out. `note` says what was converted; empty for a
// file that parse_png reads, whose samples are as they are. Throws Error as above.
DeepGrayImage convert_png(std::string_view data, const std::string& name, std::string& note);

// Reads any PNG in 8 bit gray: of 16 bits the upper 8; colours as 0.299 R + 0.587 G + 0.114 B; transparency is left
// out. Throws Error as above.
GrayImage decode_png(std::string_view data, const std::string& name);

// A PNG of those samples, the same bytes for the same image. Throws Error for an image that is empty, too
// large, or has other than width·height samples of `bits` bits.
std::string format_png(const DeepGrayImage& image);

// The same of a camera's image, compressed for speed.
std::string format_png(const GrayImage& image);

// A PNG of 16 bit red, green and blue, pixel by pixel, of linear light. Throws Error if it cannot be made.
std::string format_rgb_png(int width, int height, std::span<const std::uint16_t> samples);

// The same of 8 bit sRGB.
std::string format_colour_png(int width, int height, std::span<const std::uint8_t> samples);

}  // namespace asperity
