#pragma once

#include <array>
#include <cmath>
#include <numbers>

#include "asperity/base/random.h"

namespace asperity {

// A band-limited random function of time, a sum of sines at random frequencies and phases, read one
// step after another. Smooth to all orders, so that accelerations derived from it are exact.
class RandomWave {
 public:
  RandomWave() = default;

  // Root mean square `rms`, frequencies between `low_Hz` and `high_Hz`, one sine from each of equal parts
  // of the band, read every `step_s`.
  RandomWave(double rms, double low_Hz, double high_Hz, double step_s, Random& random) {
    const double amplitude = rms * std::sqrt(2.0 / kSines);
    for (int i = 0; i < kSines; ++i) {
      const auto k = static_cast<std::size_t>(i);
      const double frequency_Hz = low_Hz + (high_Hz - low_Hz) * (i + random.uniform()) / kSines;
      const double phase = random.uniform(0.0, 2.0 * std::numbers::pi);
      const double turn = 2.0 * std::numbers::pi * frequency_Hz * step_s;
      re_[k] = amplitude * std::cos(phase);
      im_[k] = amplitude * std::sin(phase);
      cos_[k] = std::cos(turn);
      sin_[k] = std::sin(turn);
    }
  }

  // The value now; the next call gives it one step later.
  double next() {
    double sum = 0.0;
    for (std::size_t k = 0; k < kSines; ++k) {
      sum += re_[k];
      const double re = re_[k] * cos_[k] - im_[k] * sin_[k];
      im_[k] = re_[k] * sin_[k] + im_[k] * cos_[k];
      re_[k] = re;
    }
    return sum;
  }

 private:
  static constexpr int kSines = 10;
  std::array<double, kSines> re_{}, im_{}, cos_{}, sin_{};
};

}  // namespace asperity
