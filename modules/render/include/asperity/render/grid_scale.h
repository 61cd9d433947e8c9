#pragma once

namespace asperity {

// Reciprocals and units of an image or a spline grid, so that the servo thread does not divide.
struct GridScale {
  double cells_x_per_m = 0.0;
  double cells_y_per_m = 0.0;
  double origin_x_m = 0.0;
  double origin_y_m = 0.0;
  double unit_m = 1.0;  // height of a value of 1
  double low_m = 0.0;   // height of a value of 0
};

}  // namespace asperity
