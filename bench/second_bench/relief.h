#pragma once

#include <cstddef>
#include <vector>

#include "second_scan.h"

namespace second_bench {

// Where the lowest point of a ball stands on the relief, over a strip along the path: the relief z(x, y) is sampled
// every dx × dy, and the ball's centre is the upper envelope of balls set on every point (grey dilation),
// two-dimensional, so that flanks across the path carry it as well.
class RollingTip {
 public:
  // From x = -margin to length + margin.
  RollingTip(const ScanPlan& plan, double margin_m, double half_width_m);

  struct Stand {
    double z_m = 0.0, slope = 0.0;  // height of the ball's lowest point; dz/dx
  };
  // Catmull–Rom along x, straight lines across.
  Stand at(double x_m, double y_m) const;

 private:
  double node(std::ptrdiff_t column, std::ptrdiff_t row) const;

  double dx_m_, dy_m_, x0_m_, y0_m_;
  std::ptrdiff_t columns_ = 0, rows_ = 0;
  std::vector<double> z_m_;  // row by row
};

}  // namespace second_bench
