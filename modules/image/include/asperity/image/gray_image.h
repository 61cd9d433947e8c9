#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace asperity {

// Larger images are refused before memory is taken: 64 megapixels.
inline constexpr int kLargestImageSide_px = 8192;

// An 8-bit camera image, row by row from the top. The centre of the pixel (column, row) has the
// coordinates (column, row), as in CameraCalibration.
struct GrayImage {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> pixels;

  std::uint8_t at(int column, int row) const {
    return pixels[static_cast<std::size_t>(row) * static_cast<std::size_t>(width) + static_cast<std::size_t>(column)];
  }
};

}  // namespace asperity
