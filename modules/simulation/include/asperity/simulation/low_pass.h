#pragma once

#include <cmath>
#include <numbers>

namespace asperity {

// A sensor's own low-pass as a causal filter (bilinear transform): one pole (RC) or a second-order
// Butterworth, -3 dB at `cutoff_Hz`. `T` is double or a fixed-size Eigen vector. Starts settled on its
// first input. A cut-off of 0, or one beyond 0.45 of the rate, passes everything.
template <class T>
class SensorLowPass {
 public:
  SensorLowPass(double cutoff_Hz, int poles, double rate_Hz) {
    if (cutoff_Hz <= 0.0 || cutoff_Hz >= 0.45 * rate_Hz) return;
    passes_all_ = false;
    const double w = std::tan(std::numbers::pi * cutoff_Hz / rate_Hz);
    if (poles == 1) {
      delay_s_ = 0.5 / (w * rate_Hz);
      b0_ = w / (1.0 + w);
      b1_ = b0_;
      a1_ = (w - 1.0) / (w + 1.0);
      return;
    }
    delay_s_ = 0.5 * std::numbers::sqrt2 / (w * rate_Hz);
    const double norm = 1.0 / (1.0 + std::numbers::sqrt2 * w + w * w);
    b0_ = w * w * norm;
    b1_ = 2.0 * b0_;
    b2_ = b0_;
    a1_ = 2.0 * (w * w - 1.0) * norm;
    a2_ = (1.0 - std::numbers::sqrt2 * w + w * w) * norm;
  }

  T push(const T& x) {
    if (passes_all_) return x;
    if (!settled_) {
      settled_ = true;
      z1_ = x * (1.0 - b0_);
      z2_ = x * (b2_ - a2_);
    }
    T y = b0_ * x + z1_;
    z1_ = b1_ * x - a1_ * y + z2_;
    z2_ = b2_ * x - a2_ * y;
    return y;
  }

  // By which it delays what is slow against its cut-off: the group delay at frequency 0.
  double delay_s() const { return delay_s_; }

 private:
  double delay_s_ = 0.0;
  bool passes_all_ = true;
  bool settled_ = false;
  double b0_ = 1.0, b1_ = 0.0, b2_ = 0.0, a1_ = 0.0, a2_ = 0.0;
  T z1_{}, z2_{};
};

}  // namespace asperity
