#include "asperity/signal/spectrum.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include <unsupported/Eigen/FFT>

#include "asperity/base/error.h"
#include "asperity/base/text.h"

namespace asperity {
namespace {

using Complex = std::complex<double>;
using std::numbers::pi;

std::size_t largest_prime_factor(std::size_t n) {
  std::size_t largest = 1;
  for (std::size_t p = 2; p * p <= n; ++p) {
    for (; n % p == 0; n /= p) largest = p;
  }
  return std::max(largest, n);
}

std::vector<Complex> smooth_dft(const std::vector<Complex>& x) {
  Eigen::FFT<double> fft;
  std::vector<Complex> out;
  fft.fwd(out, x);
  return out;
}

// Bluestein (1970): the transform as a convolution with a chirp, of a length that is a power of two.
std::vector<Complex> chirp_dft(const std::vector<Complex>& x) {
  const std::size_t n = x.size();
  std::size_t m = 1;
  while (m < 2 * n) m *= 2;
  std::vector<Complex> chirp(n), a(m), b(m);
  for (std::size_t k = 0; k < n; ++k) {
    // k² modulo 2n first: the angle of a large square has no digits left.
    chirp[k] = std::polar(1.0, -pi * static_cast<double>((k * k) % (2 * n)) / static_cast<double>(n));
    a[k] = x[k] * chirp[k];
    b[k] = std::conj(chirp[k]);
    if (k > 0) b[m - k] = b[k];
  }
  Eigen::FFT<double> fft;
  std::vector<Complex> fa, fb, product;
  fft.fwd(fa, a);
  fft.fwd(fb, b);
  for (std::size_t k = 0; k < m; ++k) fa[k] *= fb[k];
  fft.inv(product, fa);
  std::vector<Complex> out(n);
  for (std::size_t k = 0; k < n; ++k) out[k] = product[k] * chirp[k];
  return out;
}

std::vector<Complex> complex_dft(const std::vector<Complex>& x) {
  // Eigen's transform costs n times the largest prime factor.
  constexpr std::size_t kLargePrime = 64;
  if (x.size() < 2) return x;
  return largest_prime_factor(x.size()) > kLargePrime ? chirp_dft(x) : smooth_dft(x);
}

// exp(−2πi k/n)
Complex twiddle(std::size_t k, std::size_t n) {
  return std::polar(1.0, -2.0 * pi * static_cast<double>(k) / static_cast<double>(n));
}

// Of n real samples, n even: their pairs are the complex samples of a transform of half the length, which is the sum
// of the even samples' transform E and i times the odd ones' O; X_k = E_k + exp(−2πi k/n) O_k.
std::vector<Complex> even_real_dft(std::span<const double> x) {
  const std::size_t n = x.size(), half = n / 2;
  std::vector<Complex> pairs(half);
  for (std::size_t i = 0; i < half; ++i) pairs[i] = {x[2 * i], x[2 * i + 1]};
  const std::vector<Complex> z = complex_dft(pairs);
  std::vector<Complex> out(half + 1);
  for (std::size_t k = 0; k <= half; ++k) {
    const Complex here = z[k % half], mirror = std::conj(z[(half - k) % half]);
    const Complex even = 0.5 * (here + mirror), odd = Complex(0.0, -0.5) * (here - mirror);
    out[k] = even + twiddle(k, n) * odd;
  }
  return out;
}

// Its inverse: E and O from X_k and the conjugate of X_{n/2−k}, then the samples' pairs.
std::vector<double> even_inverse_real_dft(std::span<const Complex> spectrum, std::size_t n) {
  const std::size_t half = n / 2;
  std::vector<Complex> z(half);  // conjugated: the inverse is the conjugate of the forward transform of the conjugate
  for (std::size_t k = 0; k < half; ++k) {
    const Complex here = k == 0 ? spectrum[0].real() : spectrum[k];
    const Complex mirror = k == 0 ? spectrum[half].real() : std::conj(spectrum[half - k]);
    const Complex even = 0.5 * (here + mirror), odd = 0.5 * (here - mirror) * std::conj(twiddle(k, n));
    z[k] = std::conj(even + Complex(0.0, 1.0) * odd);
  }
  const std::vector<Complex> pairs = complex_dft(z);
  std::vector<double> x(n);
  for (std::size_t i = 0; i < half; ++i) {
    x[2 * i] = pairs[i].real() / static_cast<double>(half);
    x[2 * i + 1] = -pairs[i].imag() / static_cast<double>(half);
  }
  return x;
}

}  // namespace

std::vector<Complex> real_dft(std::span<const double> x) {
  if (x.empty()) return {};
  if (x.size() % 2 == 0) return even_real_dft(x);
  std::vector<Complex> out = complex_dft({x.begin(), x.end()});
  out.resize(x.size() / 2 + 1);
  return out;
}

std::vector<double> inverse_real_dft(std::span<const Complex> half, std::size_t n) {
  if (n == 0 || half.size() != n / 2 + 1) {
    throw Error("inverse transform to " + std::to_string(n) + " samples needs " + std::to_string(n / 2 + 1) +
                " coefficients, not " + std::to_string(half.size()));
  }
  if (n % 2 == 0) return even_inverse_real_dft(half, n);
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
