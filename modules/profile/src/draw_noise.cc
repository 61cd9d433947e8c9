#include "draw_noise.h"

#include <algorithm>
#include <cmath>
#include <complex>

#include "asperity/signal/spectrum.h"

namespace asperity {

namespace {

double density_at(std::span<const double> frequency, std::span<const double> density, double at) {
  const auto next = std::upper_bound(frequency.begin(), frequency.end(), at);
  if (next == frequency.begin() || next == frequency.end()) return 0.0;
  const auto i = static_cast<std::size_t>(next - frequency.begin());
  const double share = (at - frequency[i - 1]) / (frequency[i] - frequency[i - 1]);
  return density[i - 1] + share * (density[i] - density[i - 1]);
}

}  // namespace

std::vector<double> draw_noise(std::span<const double> frequency, std::span<const double> density, std::size_t count,
                               double spacing_mm, Random& random) {
  std::size_t n = 16;
  while (n < count) n *= 2;
  const double step = 1.0 / (static_cast<double>(n) * spacing_mm);
  std::vector<std::complex<double>> half(n / 2 + 1, 0.0);
  for (std::size_t k = 1; k < half.size(); ++k) {
    // A line of the transform holds n²/4 of the square of its amplitude, whose mean is twice the density times the
    // step.
    const double amplitude =
        0.5 * static_cast<double>(n) * std::sqrt(density_at(frequency, density, static_cast<double>(k) * step) * step);
    const double real = random.normal(), imaginary = random.normal();
    half[k] = amplitude * std::complex<double>(real, k + 1 < half.size() ? imaginary : 0.0);
  }
  std::vector<double> out = inverse_real_dft(half, n);
  out.resize(count);
  return out;
}

}  // namespace asperity
