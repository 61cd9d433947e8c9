#pragma once

#include <functional>
#include <span>
#include <vector>

#include "asperity/base/nan.h"

namespace asperity {

struct ShapeParameter {
  double value = kNan, standard_error = kNan;
};

struct Shape {
  ShapeParameter skewness, kurtosis;
};

// What is known of a Gaussian noise that is independent of the surface.
struct ShapeNoise {
  double power = 0.0;             // mean square
  double power_stderr = 0.0;      // of what is stated, not of what came out in one scan
  std::span<const double> sigma;  // at each height, as far as it changes along the profile; may be empty
  std::function<std::vector<double>()> draw;
};

// Skewness and kurtosis of what noisy heights are of. Cumulants of independent sums add, and a Gaussian has none above
// the second: with w the surface's share of the mean square (Kendall and Stuart, Advanced Theory of Statistics 1, 3.12)
//
//     Rsk of the surface = Rsk / w^(3/2)        Rku of the surface = 3 + (Rku − 3) / w²
//
// where noise that changes along the profile has a fourth cumulant of its own, 3 (mean σ⁴ − (mean σ²)²), which is taken
// off. `skewness`, `kurtosis` and `power` (mean square about the mean) are the measured ones of `height` (nan in gaps).
// The standard errors hold the spread over `draws` of the noise, added to heights scaled to the surface's power, half
// of the correction (the noise may not be Gaussian), and the noise's `power_stderr`. A kurtosis is at least 1. nan
// where the surface's power is not above 0 by two of its standard errors.
Shape shape_without_noise(std::span<const double> height, double power, double skewness, double kurtosis,
                          const ShapeNoise& noise, std::size_t draws);

}  // namespace asperity
