#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "asperity/texture/spline_grid.h"

namespace asperity {

// A height over a plane as a grey-scale image (thesis §6.5, Fig. 38): pixel (row, column) lies at
// x = column·mm_per_px_x, y = row·mm_per_px_y and has the height
//   low_m + level / (2^bits − 1) · (high_m − low_m).
// A tiling image (kPeriodic) repeats after `columns` and `rows` pixels.
struct HeightMap {
  std::size_t columns = 0;
  std::size_t rows = 0;
  double mm_per_px_x = 0.0;
  double mm_per_px_y = 0.0;
  double low_m = 0.0;
  double high_m = 0.0;
  int bits = 16;  // 8 or 16
  Border border = Border::kPeriodic;
  std::vector<std::uint16_t> level;  // row by row

  double metres_per_level() const { return (high_m - low_m) / (bits == 8 ? 255.0 : 65535.0); }
};

}  // namespace asperity
