#include "find_unknown_pitch.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

#include "asperity/base/nan.h"
#include "fft.h"

namespace bench {

namespace {

constexpr double kShortest_m = 0.3e-3, kLongest_m = 10e-3;
constexpr std::size_t kHarmonics = 4;
constexpr std::size_t kPadding = 8;    // at least so many bins to an independent frequency
constexpr double kByChance = 0.01;     // of an ordinate of the error alone among all
constexpr double kFoot = 0.02;         // of the sum: what a multiple of a pitch may have more
constexpr double kReach = 1.0 / 16.0;  // of the frequency, over which the error's density is averaged
constexpr double kLeastReach = 4.0;    // independent frequencies

// By a Hann window: a strong wave's foot must not stand out between its harmonics.
std::vector<double> periodogram(std::span<const double> x, std::size_t size) {
  std::vector<std::complex<double>> spectrum(size, 0.0);
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double u = (static_cast<double>(i) + 0.5) / static_cast<double>(x.size());
    spectrum[i] = std::isfinite(x[i]) ? (1.0 - std::cos(2.0 * std::numbers::pi * u)) * x[i] : 0.0;
  }
  fft(spectrum, -1);
  std::vector<double> out(size / 2);
  for (std::size_t k = 0; k < out.size(); ++k) out[k] = std::norm(spectrum[k]);
  return out;
}

// Means over neighbouring frequencies.
std::vector<double> smooth(const std::vector<double>& x, double bins_per_frequency) {
  std::vector<double> sums(x.size() + 1, 0.0);
  for (std::size_t i = 0; i < x.size(); ++i) sums[i + 1] = sums[i] + x[i];
  std::vector<double> out(x.size());
  for (std::size_t i = 0; i < x.size(); ++i) {
    const auto reach =
        static_cast<std::size_t>(std::max(kLeastReach * bins_per_frequency, kReach * static_cast<double>(i)));
    const std::size_t first = i < reach ? 0 : i - reach, last = std::min(i + reach + 1, x.size());
    out[i] = (sums[last] - sums[first]) / static_cast<double>(last - first);
  }
  return out;
}

}  // namespace

double find_unknown_pitch_m(std::span<const double> texture_m, std::span<const double> error_m, double spacing_m) {
  const double length_m = static_cast<double>(texture_m.size()) * spacing_m;
  if (length_m < 3.0 * kShortest_m) return asperity::kNan;
  std::size_t size = 1;
  while (size < kPadding * texture_m.size()) size <<= 1;
  const double whole_m = static_cast<double>(size) * spacing_m;
  std::vector<double> excess = periodogram(texture_m, size);
  const std::vector<double> error = smooth(periodogram(error_m, size), whole_m / length_m);
  const double clear = std::log(length_m / kShortest_m / kByChance);
  for (std::size_t k = 0; k < excess.size(); ++k) excess[k] = std::max(0.0, excess[k] - clear * error[k]);

  const auto first = static_cast<std::size_t>(std::ceil(whole_m / std::min(kLongest_m, length_m / 3.0)));
  const auto last = std::min(static_cast<std::size_t>(whole_m / kShortest_m), excess.size() - 2);
  std::vector<double> sum(last + 2, 0.0);
  if (first > last || first < 1) return asperity::kNan;
  for (std::size_t k = first - 1; k <= last + 1; ++k) {
    for (std::size_t h = 1; h <= kHarmonics && h * k < excess.size(); ++h) sum[k] += excess[h * k];
  }
  const double most = *std::max_element(sum.begin() + static_cast<std::ptrdiff_t>(first), sum.end() - 1);
  if (!(most > 0.0)) return asperity::kNan;
  for (std::size_t k = last; k >= first; --k) {
    if (sum[k] < (1.0 - kFoot) * most || sum[k] < sum[k - 1] || sum[k] < sum[k + 1]) continue;
    const double bend = sum[k - 1] - 2.0 * sum[k] + sum[k + 1];
    return whole_m / (static_cast<double>(k) + (bend < 0.0 ? 0.5 * (sum[k - 1] - sum[k + 1]) / bend : 0.0));
  }
  return asperity::kNan;
}

}  // namespace bench
