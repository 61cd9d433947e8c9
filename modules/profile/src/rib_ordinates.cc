#include "rib_ordinates.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <numbers>
#include <vector>

#include "asperity/signal/statistics.h"
#include "bent_path.h"

namespace asperity {

namespace {

constexpr double kSlowestCrossing = 0.3;  // of the speed
constexpr double kStepOfFrequency = 0.5;  // over the window's extent: between two, a Hann window's line keeps 0.92
constexpr double kStepOfDirection = 0.5;  // of a wave, over the extent across the window's longest
constexpr double kPiecesOfWave = 6.0;     // at least
constexpr double kMostSums = 1e9;
constexpr double kTurn = 2.0 * std::numbers::pi;

struct Extent {
  double length_m = 0.0, width_m = 0.0;
};

// Of a window's path along and across its main direction.
Extent extent_of(const std::vector<Eigen::Vector2d>& at_m) {
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  for (const Eigen::Vector2d& p : at_m) mean += p / static_cast<double>(at_m.size());
  double xx = 0.0, xy = 0.0, yy = 0.0;
  for (const Eigen::Vector2d& p : at_m) {
    const Eigen::Vector2d d = p - mean;
    xx += d.x() * d.x();
    xy += d.x() * d.y();
    yy += d.y() * d.y();
  }
  const double angle = 0.5 * std::atan2(2.0 * xy, xx - yy);
  const auto range_along = [&](const Eigen::Vector2d& n) {
    double low = 0.0, high = 0.0;
    for (const Eigen::Vector2d& p : at_m) {
      low = std::min(low, n.dot(p - mean));
      high = std::max(high, n.dot(p - mean));
    }
    return high - low;
  };
  const double c = std::cos(angle), s = std::sin(angle);
  return {range_along({c, s}), range_along({-s, c})};
}

// How fast ribs of this normal are crossed, of the speed, over pieces of eight points.
void add_crossing_rates(const PassedWindow& window, const Eigen::Vector2d& normal, std::vector<double>& rates) {
  for (std::size_t i = 8; i < window.unrolled_m.size(); i += 8) {
    const double step_m = window.s_m[i] - window.s_m[i - 8];
    if (step_m > 0.0) rates.push_back(std::abs(normal.dot(window.unrolled_m[i] - window.unrolled_m[i - 8])) / step_m);
  }
}

// Means of `points` heights each, none over a gap: several to a wave are enough.
struct Pieces {
  std::vector<Eigen::Vector2d> at_m;
  std::vector<double> weight, weighted_m;
};

Pieces pieces_of(const PassedWindow& window, std::size_t points) {
  Pieces out;
  std::size_t i = 0;
  while (i < window.height_m.size()) {
    if (!std::isfinite(window.height_m[i])) {
      ++i;
      continue;
    }
    const std::size_t first = i;
    Eigen::Vector2d at_m = Eigen::Vector2d::Zero();
    double weight = 0.0, weighted_m = 0.0;
    for (; i < window.height_m.size() && i - first < points && std::isfinite(window.height_m[i]); ++i) {
      at_m += window.unrolled_m[i] - window.unrolled_m.front();
      weight += window.weight[i];
      weighted_m += window.weight[i] * window.height_m[i];
    }
    out.at_m.emplace_back(at_m / static_cast<double>(i - first));
    out.weight.push_back(weight);
    out.weighted_m.push_back(weighted_m);
  }
  return out;
}

// Adds the ordinates of one window at k = low + j step, j < power.size(). The phases go on by one product each.
void add_ordinates(const Pieces& pieces, const Eigen::Vector2d& normal, double low, double step,
                   std::vector<double>& power) {
  std::vector<std::complex<double>> sums(power.size());
  double weights = 0.0;
  for (std::size_t i = 0; i < pieces.at_m.size(); ++i) {
    weights += pieces.weight[i];
    const double u = normal.dot(pieces.at_m[i]);
    std::complex<double> phase = std::polar(1.0, -kTurn * low * u) * pieces.weighted_m[i];
    const std::complex<double> turn = std::polar(1.0, -kTurn * step * u);
    for (std::complex<double>& sum : sums) {
      sum += phase;
      phase = {phase.real() * turn.real() - phase.imag() * turn.imag(),
               phase.real() * turn.imag() + phase.imag() * turn.real()};
    }
  }
  for (std::size_t j = 0; j < power.size(); ++j) power[j] += 2.0 * std::norm(sums[j]) / (weights * weights);
}

}  // namespace

bool bends_over_ribs(std::span<const Eigen::Vector2d> unrolled_m, double spacing_m) {
  if (unrolled_m.size() < 3) return false;
  const BentPath path(unrolled_m, spacing_m);
  return path.bends() || !(path.chord_m() > 0.0);
}

std::optional<double> highest_of_ribs(const PassedWindows& passed, double frequency_Hz) {
  const double longest_m = passed.fast_mps / frequency_Hz, shortest_m = passed.slow_mps / frequency_Hz;
  const double joined = std::max(1.0, std::floor(shortest_m / (kPiecesOfWave * passed.spacing_m)));
  std::vector<Pieces> pieces;
  double points = 0.0;
  Extent most;
  for (const PassedWindow& window : passed.windows) {
    if (window.unrolled_m.size() != window.height_m.size()) return std::nullopt;
    const Extent extent = extent_of(window.unrolled_m);
    most.length_m = std::max(most.length_m, extent.length_m);
    most.width_m = std::max(most.width_m, extent.width_m);
    pieces.push_back(pieces_of(window, static_cast<std::size_t>(joined)));
    points += static_cast<double>(pieces.back().at_m.size());
  }
  const double step = kStepOfFrequency / std::max(most.length_m, shortest_m);
  const double directions =
      std::ceil(std::numbers::pi * std::max(most.width_m, shortest_m) / (kStepOfDirection * shortest_m));
  const double frequencies = (1.0 / (kSlowestCrossing * shortest_m) - 1.0 / longest_m) / step + 2.0;
  if (!(points * directions * frequencies < kMostSums)) return std::nullopt;
  double highest = 0.0;
  for (double d = 0.0; d < directions; d += 1.0) {
    const double angle = std::numbers::pi * d / directions;
    const Eigen::Vector2d normal(std::cos(angle), std::sin(angle));
    std::vector<double> rates;
    for (const PassedWindow& window : passed.windows) add_crossing_rates(window, normal, rates);
    if (rates.empty() || median(rates) < kSlowestCrossing) continue;
    // Where the path crosses ribs straight on they are a line over time, at other places not.
    const double low = 1.0 / (longest_m * percentile(rates, 95.0)), high = 1.0 / (shortest_m * median(rates));
    std::vector<double> power(static_cast<std::size_t>((high - low) / step) + 2, 0.0);
    for (const Pieces& window : pieces) add_ordinates(window, normal, low, step, power);
    highest = std::max(highest, *std::max_element(power.begin(), power.end()));
  }
  const double turned = 0.5 * kTurn * joined * passed.spacing_m / shortest_m;  // half the angle of a piece
  const double left = std::pow(std::sin(turned) / turned, 2);
  return highest / left / static_cast<double>(passed.windows.size());
}

}  // namespace asperity
