#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace asperity {

// Larger images are refused before memory is taken: 64 megapixels.
inline constexpr int kLargestImageSide_px = 8192;

// A gray image, row by row from the top, of levels 0 (black) to 2^bits − 1. The centre of the pixel (column, row) has
// the coordinates (column, row), as in CameraCalibration.
template <class Sample>
struct BasicGrayImage {
  int width = 0;
  int height = 0;
  std::vector<Sample> pixels;
  int bits = 8 * static_cast<int>(sizeof(Sample));  // of a level, 8 or 16

  Sample at(int column, int row) const {
    return pixels[static_cast<std::size_t>(row) * static_cast<std::size_t>(width) + static_cast<std::size_t>(column)];
  }
};

using GrayImage = BasicGrayImage<std::uint8_t>;       // a camera's
using DeepGrayImage = BasicGrayImage<std::uint16_t>;  // heights

}  // namespace asperity
