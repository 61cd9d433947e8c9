#include "pitch_by_chance.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

namespace bench {

namespace {

constexpr double kShortestPitch_m = 0.3e-3, kLongestPitch_m = 10e-3;  // find_unknown_pitch.cc
constexpr double kRandomSurface = 0.01;
constexpr int kPitchHarmonics = 4;
constexpr double kNearest = 2.5, kFarthest = 16.0, kStep = 0.5;  // of the neighbours, independent frequencies
constexpr double kHannCorrelation = 1.5;  // independent frequencies that a Hann window takes for one

// |Σ w x exp(−2πi f s)|² by a Hann window; the scale does not matter.
double ordinate(std::span<const double> x, double cycles_over_length) {
  const auto n = static_cast<double>(x.size());
  const std::complex<double> step = std::polar(1.0, -2.0 * std::numbers::pi * cycles_over_length / n);
  std::complex<double> turn = 1.0, sum = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i, turn *= step) {
    if (!std::isfinite(x[i])) continue;
    sum += (1.0 - std::cos(2.0 * std::numbers::pi * (static_cast<double>(i) + 0.5) / n)) * x[i] * turn;
  }
  return std::norm(sum);
}

double median(std::vector<double> x) {
  const auto middle = x.begin() + static_cast<std::ptrdiff_t>(x.size() / 2);
  std::nth_element(x.begin(), middle, x.end());
  return *middle;
}

// Of an ordinate among its neighbours: −ln of the probability that a random surface has one as high there.
double rarity_at(std::span<const double> x, double cycles) {
  std::vector<double> around;
  for (double away = kNearest; away <= kFarthest; away += kStep) {
    if (cycles - away > 1.0) around.push_back(ordinate(x, cycles - away));
    around.push_back(ordinate(x, cycles + away));
  }
  const double density = median(around) / std::numbers::ln2;
  if (!(density > 0.0)) return 0.0;
  // The median of n exponential variables has the relative variance 1/(n ln²2).
  const double independent = static_cast<double>(around.size()) * kStep / kHannCorrelation;
  const double v = 1.0 / (independent * std::numbers::ln2 * std::numbers::ln2);
  return std::log1p(v * ordinate(x, cycles) / density) / v;
}

}  // namespace

bool exceeds_random_surface(std::span<const double> texture_m, double spacing_m, double pitch_m) {
  const double length_m = static_cast<double>(texture_m.size()) * spacing_m;
  if (!(pitch_m > 0.0) || length_m < 3.0 * pitch_m) return false;
  double sum = 0.0, highest = 0.0;
  for (int h = 1; h <= kPitchHarmonics && 2.0 * spacing_m * h < pitch_m; ++h) {
    const double rarity = rarity_at(texture_m, h * length_m / pitch_m);
    sum += rarity;
    highest = std::max(highest, rarity);
  }
  const double frequencies = length_m / kShortestPitch_m - length_m / std::min(kLongestPitch_m, length_m / 3.0);
  const double slope = std::sqrt((1.0 + 4.0 + 9.0 + 16.0) / kPitchHarmonics);
  const double of_sum = frequencies * slope * std::pow(sum, kPitchHarmonics - 0.5) * std::exp(-sum) / 6.0;
  // One ordinate among those of four harmonics of all pitches.
  const double of_one = kPitchHarmonics * frequencies * std::sqrt(highest) * std::exp(-highest);
  return std::min(of_sum, of_one) < 0.5 * kRandomSurface;
}

}  // namespace bench
