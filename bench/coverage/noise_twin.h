#pragma once

#include <cmath>
#include <complex>
#include <cstddef>
#include <numbers>
#include <span>
#include <vector>

#include "asperity/base/random.h"
#include "fft.h"

namespace bench {

// Noise with the amplitudes of `error_m`'s spectrum and random phases: another run of the same disturbance.
class NoiseTwin {
 public:
  explicit NoiseTwin(std::span<const double> error_m) : n_(error_m.size()) {
    std::size_t size = 1;
    while (size < n_) size <<= 1;
    spectrum_.assign(size, 0.0);
    for (std::size_t i = 0; i < n_; ++i) spectrum_[i] = std::isfinite(error_m[i]) ? error_m[i] : 0.0;
    fft(spectrum_, -1);
  }

  std::vector<double> draw(asperity::Random& random) const {
    std::vector<std::complex<double>> x(spectrum_.size());
    const std::size_t half = x.size() / 2;
    for (std::size_t k = 1; k < half; ++k) {
      x[k] = std::polar(std::abs(spectrum_[k]), 2.0 * std::numbers::pi * random.uniform());
      x[x.size() - k] = std::conj(x[k]);
    }
    fft(x, 1);
    std::vector<double> out(n_);
    // The padding's share of the power belongs to the points.
    const double scale =
        std::sqrt(static_cast<double>(x.size()) / static_cast<double>(n_)) / static_cast<double>(x.size());
    for (std::size_t i = 0; i < n_; ++i) out[i] = scale * x[i].real();
    return out;
  }

 private:
  std::size_t n_;
  std::vector<std::complex<double>> spectrum_;
};

}  // namespace bench
