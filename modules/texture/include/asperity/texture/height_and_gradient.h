#pragma once

namespace asperity {

// A height field at a point: x along the scan path, y across it.
struct HeightAndGradient {
  double height_m = 0.0;
  double slope_x = 0.0;  // ∂h/∂x, metres a metre
  double slope_y = 0.0;
};

}  // namespace asperity
