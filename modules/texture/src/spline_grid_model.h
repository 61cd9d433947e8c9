#pragma once

#include <algorithm>

#include "asperity/texture/servo_tables.h"
#include "asperity/texture/spline_grid.h"
#include "asperity/texture/texture_hash.h"

namespace asperity {

// What the models that hold a spline grid share.
inline GridScale grid_scale(const SplineGrid& grid) {
  return {1.0 / grid.spacing_x_m, 1.0 / grid.spacing_y_m, grid.origin_x_m, grid.origin_y_m, 1.0, 0.0};
}

inline void add_grid_to(TextureHash& hash, const SplineGrid& g) {
  hash.add(static_cast<std::uint64_t>(g.columns), static_cast<std::uint64_t>(g.rows), g.spacing_x_m, g.spacing_y_m,
           g.origin_x_m, g.origin_y_m, static_cast<std::uint64_t>(g.border), g.coefficient_m);
}

}  // namespace asperity
