#pragma once

#include <array>
#include <cstddef>
#include <string_view>
#include <vector>

namespace asperity {

// What a surface is beyond its border: its nearest border point, its mirror image, or itself again.
enum class Border { kClamp, kMirror, kPeriodic };
inline constexpr std::array<std::string_view, 3> kBorderNames{"clamp", "mirror", "periodic"};

// A height over a plane as a tensor product of uniform cubic B-splines β (C²):
//   h(x, y) = Σ c[row·columns + column] β((x − origin_x_m)/spacing_x_m − column) β((y − origin_y_m)/spacing_y_m − row)
// A periodic grid repeats after columns·spacing_x_m; the others span from the second to the last but one
// column (row), whose splines are whole there.
struct SplineGrid {
  std::size_t columns = 0;
  std::size_t rows = 0;
  double spacing_x_m = 0.0;
  double spacing_y_m = 0.0;
  double origin_x_m = 0.0;
  double origin_y_m = 0.0;
  Border border = Border::kPeriodic;
  std::vector<double> coefficient_m;
};

}  // namespace asperity
