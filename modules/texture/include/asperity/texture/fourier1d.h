#pragma once

#include <numbers>
#include <vector>

namespace asperity {

// A periodic height along the scan path (thesis §6.5, erratum 18):
//   g(x) = mean_m + Σ_{j=1..N} a_j cos(j ω x) + b_j sin(j ω x),  ω = 2π / L.
// The length is in millimetres, as in the seed and in the file.
struct Fourier1d {
  double length_mm = 10.0;
  std::vector<double> a_m;  // a_m[j - 1] is a_j
  std::vector<double> b_m;  // as long as a_m
  double mean_m = 0.0;

  double omega_rad_per_mm() const { return 2.0 * std::numbers::pi / length_mm; }
};

}  // namespace asperity
