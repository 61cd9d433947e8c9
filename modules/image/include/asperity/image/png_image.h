#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace asperity {

// A grey-scale image, row by row from the top.
struct GreyImage {
  std::size_t columns = 0;
  std::size_t rows = 0;
  int bits = 16;  // 8 or 16
  std::vector<std::uint16_t> level;
};

inline constexpr std::size_t kMostPixelsASide = 8192;
inline constexpr std::size_t kMostPixels = 1 << 26;

// Reads a PNG of 8 or 16 bit grey without an alpha channel, as its samples stand: no gamma, no scaling.
// Anything else is refused. `name` is what messages call it. Throws Error naming it for data that is
// damaged or cut off, for more than kMostPixelsASide or kMostPixels, all before the memory is taken.
GreyImage parse_png(std::string_view data, const std::string& name);

// A PNG of those samples, the same bytes for the same image. Throws Error for an image that is empty, too
// large, or has other than columns·rows samples of `bits` bits.
std::string format_png(const GreyImage& image);

}  // namespace asperity
