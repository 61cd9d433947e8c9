#pragma once

#include "asperity/texture/fourier1d.h"

namespace asperity {

struct HeightAndSlope {
  double height_m = 0.0;
  double slope = 0.0;  // dg/dx, metres a metre
};

// g and its derivative `x_m` along the scan path (thesis §6.5). Takes time in proportion to N; does not
// allocate. Realtime-safe: yes, thread-safe: yes. nan for an x that is not finite.
HeightAndSlope evaluate_height(const Fourier1d& texture, double x_m) noexcept;

// The lowest height of a period, to rounding: found on a grid and refined wherever the second
// derivative's bound lets a lower point lie between.
double lowest_height_m(const Fourier1d& texture);

// What must be added for the lowest point to lie on the geometric surface (erratum 20).
double height_offset_m(const Fourier1d& texture);

}  // namespace asperity
