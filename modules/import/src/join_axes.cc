#include "join_axes.h"

#include <cmath>
#include <complex>
#include <utility>

#include "asperity/signal/spectrum.h"

namespace asperity {

std::vector<double> join_axes(std::vector<std::vector<double>> axes) {
  for (std::vector<double>& axis : axes) {
    double mean = 0.0;
    for (const double v : axis) mean += v / static_cast<double>(axis.size());
    for (double& v : axis) v -= mean;
  }
  if (axes.size() == 1) return std::move(axes.front());
  const std::size_t n = axes.front().size();
  std::vector<double> power(n / 2 + 1, 0.0);
  std::vector<std::complex<double>> sum(n / 2 + 1);
  for (const std::vector<double>& axis : axes) {
    const auto spectrum = real_dft(axis);
    for (std::size_t k = 0; k < spectrum.size(); ++k) {
      power[k] += std::norm(spectrum[k]);
      sum[k] += spectrum[k];
    }
  }
  for (std::size_t k = 0; k < sum.size(); ++k) {
    const double length = std::abs(sum[k]);
    sum[k] = length > 0.0 ? sum[k] * (std::sqrt(power[k]) / length) : std::complex<double>(std::sqrt(power[k]), 0.0);
  }
  // The first, and of an even number of samples the last, is real.
  sum.front() = sum.front().real();
  if (n % 2 == 0) sum.back() = std::copysign(std::sqrt(power.back()), sum.back().real());
  return inverse_real_dft(sum, n);
}

}  // namespace asperity
