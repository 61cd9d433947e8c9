#pragma once

#include <cmath>
#include <numbers>

namespace asperity {

// A second-order Butterworth filter by the bilinear transform, its -3 dB point exact; transposed direct form II.
class SecondOrderFilter {
 public:
  static SecondOrderFilter high_pass(double cutoff_Hz, double rate_Hz) {
    const double k = std::tan(std::numbers::pi * cutoff_Hz / rate_Hz);
    return SecondOrderFilter(1.0, -2.0, k);
  }
  static SecondOrderFilter low_pass(double cutoff_Hz, double rate_Hz) {
    const double k = std::tan(std::numbers::pi * cutoff_Hz / rate_Hz);
    return SecondOrderFilter(k * k, 2.0 * k * k, k);
  }

  double operator()(double x) noexcept {
    const double y = b0_ * x + s1_;
    s1_ = b1_ * x - a1_ * y + s2_;
    s2_ = b2_ * x - a2_ * y;
    return y;
  }

  // As if 0 had been its input for ever.
  void clear() noexcept { s1_ = s2_ = 0.0; }

  // As if `x` had been its input for ever and 0 its output: what a high-pass makes of a constant.
  void start_high_pass_at(double x) noexcept {
    s1_ = -b0_ * x;
    s2_ = b2_ * x;
  }

 private:
  SecondOrderFilter(double b0, double b1, double k) {
    const double a0 = 1.0 + std::numbers::sqrt2 * k + k * k;
    b0_ = b2_ = b0 / a0;
    b1_ = b1 / a0;
    a1_ = 2.0 * (k * k - 1.0) / a0;
    a2_ = (1.0 - std::numbers::sqrt2 * k + k * k) / a0;
  }

  double b0_ = 0.0, b1_ = 0.0, b2_ = 0.0, a1_ = 0.0, a2_ = 0.0;
  double s1_ = 0.0, s2_ = 0.0;
};

}  // namespace asperity
