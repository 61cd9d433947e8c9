#include "draw_noise.h"

#include <cmath>
#include <complex>

#include "asperity/signal/spectrum.h"

namespace asperity {

namespace {

// A density between its points, 0 beyond them, asked for at frequencies that rise.
class RisingDensity {
 public:
  RisingDensity(std::span<const double> frequency, std::span<const double> density)
      : frequency_(frequency), density_(density) {}

  double at(double frequency) {
    while (next_ < frequency_.size() && frequency_[next_] <= frequency) ++next_;
    if (next_ == 0 || next_ == frequency_.size()) return 0.0;
    const double share = (frequency - frequency_[next_ - 1]) / (frequency_[next_] - frequency_[next_ - 1]);
    return density_[next_ - 1] + share * (density_[next_] - density_[next_ - 1]);
  }

 private:
  std::span<const double> frequency_, density_;
  std::size_t next_ = 0;  // the first point beyond the last frequency
};

}  // namespace

std::vector<double> draw_noise(std::span<const double> frequency, std::span<const double> density, std::size_t count,
                               double spacing_mm, Random& random) {
  std::size_t n = 16;
  while (n < count) n *= 2;
  const double step = 1.0 / (static_cast<double>(n) * spacing_mm);
  std::vector<std::complex<double>> half(n / 2 + 1, 0.0);
  RisingDensity rising(frequency, density);
  for (std::size_t k = 1; k < half.size(); ++k) {
    // A line of the transform holds n²/4 of the square of its amplitude, whose mean is twice the density times the
    // step.
    const double amplitude = 0.5 * static_cast<double>(n) * std::sqrt(rising.at(static_cast<double>(k) * step) * step);
    const double real = random.normal(), imaginary = random.normal();
    half[k] = amplitude * std::complex<double>(real, k + 1 < half.size() ? imaginary : 0.0);
  }
  std::vector<double> out = inverse_real_dft(half, n);
  out.resize(count);
  return out;
}

}  // namespace asperity
