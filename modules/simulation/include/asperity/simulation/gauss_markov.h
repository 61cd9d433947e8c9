#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "asperity/base/random.h"

namespace asperity {

// A first-order Gauss–Markov process, stationary from its first value: standard deviation `sigma`, autocorrelation
// exp(−|τ|/time_s).
class GaussMarkov {
 public:
  GaussMarkov() = default;
  GaussMarkov(double sigma, double time_s, Random& random)
      : sigma_(sigma), time_s_(time_s), value_(sigma * random.normal()) {}

  // The value `step_s` later.
  double next(double step_s, Random& random) {
    const double keep = std::exp(-step_s / time_s_);
    value_ = keep * value_ + sigma_ * std::sqrt(1.0 - keep * keep) * random.normal();
    return value_;
  }

 private:
  double sigma_ = 0.0, time_s_ = 1.0, value_ = 0.0;
};

// Noise whose density falls about as 1/f from 0.03 to 30 Hz, RMS `sigma`: four Gauss–Markov processes of equal power,
// their corners a decade apart.
class FlickerNoise {
 public:
  FlickerNoise() = default;
  FlickerNoise(double sigma, Random& random) {
    double corner_Hz = 0.03;
    for (GaussMarkov& part : parts_) {
      part = GaussMarkov(0.5 * sigma, 1.0 / (2.0 * std::numbers::pi * corner_Hz), random);
      corner_Hz *= 10.0;
    }
  }
  double next(double step_s, Random& random) {
    double sum = 0.0;
    for (GaussMarkov& part : parts_) sum += part.next(step_s, random);
    return sum;
  }

 private:
  std::array<GaussMarkov, 4> parts_;
};

}  // namespace asperity
