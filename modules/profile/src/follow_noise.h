#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "asperity/base/nan.h"
#include "asperity/base/random.h"
#include "asperity/profile/texture_noise.h"

namespace asperity {

// What simulation and extrapolation needs (measure_roughness_under_noise.h).

inline constexpr std::uint64_t kNoiseSeed = 20'260'101;

// Draws for a profile of `count` heights: fewer where it is long, whose parameters vary little.
std::size_t noise_draws(std::size_t count);

// The mean over the draws, and the spread of single ones.
class Spread {
 public:
  void add(double x) {
    if (!std::isfinite(x)) {
      ++missing_;
      return;
    }
    ++count_;
    const double step = x - mean_;
    mean_ += step / count_;
    square_ += step * (x - mean_);
  }
  double mean() const { return count_ > 0.0 ? mean_ : kNan; }
  // nan where most draws do not have the value: the others are not a fair sample.
  double deviation() const { return count_ > 1.0 && count_ >= missing_ ? std::sqrt(square_ / (count_ - 1.0)) : kNan; }

 private:
  double count_ = 0.0, missing_ = 0.0, mean_ = 0.0, square_ = 0.0;
};

// Noise of the spectrum `psd_m2_mm` over the frequencies of `noise`, as large at each point as `sigma_m` says (empty:
// the same everywhere).
std::vector<double> draw_shaped_noise(const TextureNoise& noise, const std::vector<double>& psd_m2_mm,
                                      const std::vector<double>& sigma_m, std::size_t count, double spacing_m,
                                      Random& random);

inline double signed_square(double x) { return x * std::abs(x); }

}  // namespace asperity
