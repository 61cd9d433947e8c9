#include "asperity/signal/spectrum.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "asperity/base/error.h"
#include "asperity/base/text.h"
#include "fourier_transform.h"

namespace asperity {
namespace {

using Complex = std::complex<double>;
using std::numbers::pi;

}  // namespace

std::vector<Complex> real_dft(std::span<const double> x) {
  if (x.empty()) return {};
  if (x.size() % 2 == 0) return even_real_dft(x);
  std::vector<Complex> out = complex_dft(std::vector<Complex>(x.begin(), x.end()));
  out.resize(x.size() / 2 + 1);
  return out;
}

std::vector<double> inverse_real_dft(std::span<const Complex> half, std::size_t n) {
  if (n == 0 || half.size() != n / 2 + 1) {
    throw Error("inverse transform to " + std::to_string(n) + " samples needs " + std::to_string(n / 2 + 1) +
                " coefficients, not " + std::to_string(half.size()));
  }
  if (n % 2 == 0) return even_inverse_real_dft(half);
  // The inverse is the conjugate of the forward transform of the conjugate, divided by n.
  std::vector<Complex> full(n);
  for (std::size_t k = 0; k < half.size(); ++k) {
    full[k] = std::conj(half[k]);
    if (k > 0) full[n - k] = half[k];
  }
  full[0] = half[0].real();
  const std::vector<Complex> out = complex_dft(full);
  std::vector<double> x(n);
  for (std::size_t i = 0; i < n; ++i) x[i] = out[i].real() / static_cast<double>(n);
  return x;
}

PowerSpectrum welch(std::span<const double> x, double rate, std::size_t segment_samples) {
  if (!(rate > 0.0)) throw Error("spectrum: rate must be positive, not " + number_text(rate));
  const std::size_t n = std::min(segment_samples, x.size());
  if (n < 4) throw Error("spectrum: a segment needs at least 4 samples, not " + std::to_string(n));
  std::vector<double> window(n), taper(n);
  double power = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    window[i] = 0.5 - 0.5 * std::cos(2.0 * pi * static_cast<double>(i) / static_cast<double>(n));
    power += window[i] * window[i];
  }
  PowerSpectrum out;
  out.frequency.resize(n / 2 + 1);
  out.density.assign(n / 2 + 1, 0.0);
  for (std::size_t k = 0; k < out.frequency.size(); ++k) {
    out.frequency[k] = static_cast<double>(k) * rate / static_cast<double>(n);
  }
  for (std::size_t start = 0; start + n <= x.size(); start += n - n / 2) {
    double mean = 0.0;
    for (std::size_t i = 0; i < n; ++i) mean += x[start + i];
    mean /= static_cast<double>(n);
    for (std::size_t i = 0; i < n; ++i) taper[i] = window[i] * (x[start + i] - mean);
    const std::vector<Complex> half = real_dft(taper);
    for (std::size_t k = 0; k < half.size(); ++k) out.density[k] += std::norm(half[k]);
    ++out.segments;
  }
  for (std::size_t k = 0; k < out.density.size(); ++k) {
    const bool alone = k == 0 || (n % 2 == 0 && k == n / 2);  // no mirror image to add
    out.density[k] *= (alone ? 1.0 : 2.0) / (rate * power * static_cast<double>(out.segments));
  }
  return out;
}

}  // namespace asperity
