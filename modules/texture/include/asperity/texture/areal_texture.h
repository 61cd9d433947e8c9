#pragma once

#include <cstdint>
#include <vector>

#include "asperity/texture/spline_grid.h"

namespace asperity {

// A height over a plane fitted to many strokes or to an areal map.
struct ArealTexture {
  SplineGrid surface;
  std::vector<std::uint8_t> supported;  // a coefficient: 1 where heights determine it, 0 where smoothness alone does
  std::vector<double> sigma_m{};        // standard deviation of the height at each coefficient's point; empty: unknown
};

}  // namespace asperity
