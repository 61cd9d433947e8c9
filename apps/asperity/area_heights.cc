#include "area_heights.h"

#include <algorithm>
#include <cmath>
#include <variant>

#include "asperity/base/error.h"
#include "asperity/base/nan.h"
#include "asperity/base/text.h"
#include "asperity/texture/evaluate_spline_grid.h"
#include "asperity/texture/texture_file.h"

namespace asperity::app {

AreaHeights read_area_heights(const std::string& file, const ArealTextureConfig& config) {
  const Texture texture = read_texture(file);
  const auto* areal = std::get_if<ArealTexture>(&texture.model);
  if (areal == nullptr)
    throw Error(printable(file, 200) + ": not an areal texture; its heights are not on a grid that was measured");
  const SplineGrid& grid = areal->surface;
  const auto is_known = [&](std::size_t i) { return areal->supported.empty() || areal->supported[i] != 0; };
  // The rectangle of what is known: a map's grid reaches further.
  std::size_t left = grid.columns, right = 0, top = grid.rows, bottom = 0;
  for (std::size_t i = 0; i < grid.columns * grid.rows; ++i) {
    if (!is_known(i)) continue;
    left = std::min(left, i % grid.columns);
    right = std::max(right, i % grid.columns);
    top = std::min(top, i / grid.columns);
    bottom = std::max(bottom, i / grid.columns);
  }
  if (left > right) throw Error(printable(file, 200) + ": no point of its grid has a height");
  AreaHeights out;
  out.map = {grid.spacing_x_m, grid.spacing_y_m, right - left + 1, bottom - top + 1, {}};
  const bool has_sigma = areal->sigma_m.size() == grid.columns * grid.rows;
  double squares = 0.0, count = 0.0;
  for (std::size_t row = top; row <= bottom; ++row) {
    for (std::size_t column = left; column <= right; ++column) {
      const std::size_t i = row * grid.columns + column;
      const double x_m = grid.origin_x_m + static_cast<double>(column) * grid.spacing_x_m;
      const double y_m = grid.origin_y_m + static_cast<double>(row) * grid.spacing_y_m;
      out.map.height_m.push_back(is_known(i) ? evaluate_height(grid, x_m, y_m).height_m : kNan);
      if (!has_sigma) continue;
      out.noise.sigma_m.push_back(areal->sigma_m[i]);
      if (!is_known(i)) continue;
      squares += areal->sigma_m[i] * areal->sigma_m[i];
      count += 1.0;
    }
  }
  if (!(squares > 0.0)) return out;
  out.noise.rms_m = std::sqrt(squares / count);
  const double sal_m = measure_areal_texture(out.map, config).Sal_m;
  out.noise.correlation_m = std::isfinite(sal_m) ? sal_m : 0.0;
  return out;
}

}  // namespace asperity::app
