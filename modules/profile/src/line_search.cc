#include "line_search.h"

#include <algorithm>
#include <cmath>
#include <complex>

#include "asperity/signal/spectrum.h"
#include "asperity/signal/statistics.h"
#include "spectrum_at.h"

namespace asperity {

namespace {

constexpr std::size_t kPadding = 4;   // bins to an independent frequency
constexpr std::size_t kNearest = 2;   // neighbours, in independent frequencies: a line's own foot is left out
constexpr std::size_t kFarthest = 8;  // as far as a hand's tremor keeps its density
constexpr std::size_t kFewest = 4;    // neighbours of one side
constexpr double kByChance = 0.01;    // of finding a line in noise
constexpr double kPitchReach = 0.02;  // relative: as far as a first pitch may be off

}  // namespace

LineSearch::LineSearch(std::span<const double> height_m, double spacing_m, std::span<const double> frequency,
                       std::span<const double> noise_psd_m2_mm, double shortest_m) {
  std::vector<double> x(kPadding * height_m.size(), 0.0);
  double points = 0.0, sum = 0.0;
  for (const double h : height_m) {
    if (!std::isfinite(h)) continue;
    points += 1.0;
    sum += h;
  }
  for (std::size_t i = 0; i < height_m.size(); ++i) {
    if (std::isfinite(height_m[i])) x[i] = height_m[i] - sum / points;
  }
  length_m_ = spacing_m * static_cast<double>(x.size());
  searched_ = std::max(2.0, spacing_m * static_cast<double>(height_m.size()) / shortest_m);
  if (points == 0.0) return;
  for (const std::complex<double>& line : real_dft(x)) {
    power_.push_back(2e3 * spacing_m * std::norm(line) / points);
    const double at = 1e-3 * static_cast<double>(power_.size() - 1) / length_m_;
    noise_.push_back(spectrum_at(frequency, noise_psd_m2_mm, at));
  }
}

bool LineSearch::is_line(std::size_t bin, double trials, double near_trials) const {
  if (!(power_[bin] > std::log(trials / kByChance) * noise_[bin])) return false;
  std::vector<double> below, above;
  for (std::size_t j = kNearest; j <= kFarthest; ++j) {
    if (bin > j * kPadding) below.push_back(power_[bin - j * kPadding]);
    if (bin + j * kPadding < power_.size()) above.push_back(power_[bin + j * kPadding]);
  }
  if (below.size() < kFewest && above.size() < kFewest) return true;
  // The higher side: at the edge of a band, as a tremor's, the other one is empty.
  const double around =
      std::max(below.size() < kFewest ? 0.0 : median(below), above.size() < kFewest ? 0.0 : median(above));
  const auto m = static_cast<double>(below.size() + above.size());
  const double clear = 0.5 * m * (std::pow(near_trials / kByChance, 2.0 / m) - 1.0);
  return power_[bin] > clear * around / std::log(2.0);
}

bool LineSearch::has_line(double pitch_m, int harmonic) const {
  const double middle = harmonic * length_m_ / pitch_m, reach = std::max(1.0, kPitchReach * middle);
  const auto first = static_cast<std::size_t>(std::max(1.0, std::ceil(middle - reach)));
  const auto last = static_cast<std::size_t>(middle + reach);
  // Noise may have led the first search here from anywhere; where a surface or a hand has power, it took the highest of
  // the neighbours.
  const double near_trials = 2.0 * kFarthest + std::max(1.0, 2.0 * reach / static_cast<double>(kPadding));
  for (std::size_t bin = first; bin <= last && bin < power_.size(); ++bin) {
    if (is_line(bin, searched_ * near_trials, near_trials)) return true;
  }
  return false;
}

double LineSearch::find_line_m(double shortest_m, double longest_m) const {
  const auto first = static_cast<std::size_t>(std::max(1.0, std::ceil(length_m_ / longest_m)));
  const auto last = static_cast<std::size_t>(length_m_ / shortest_m);
  std::size_t best = 0;
  for (std::size_t bin = first; bin <= last && bin < power_.size(); ++bin) {
    if ((best == 0 || power_[bin] > power_[best]) && is_line(bin, searched_, searched_)) best = bin;
  }
  return best > 0 ? length_m_ / static_cast<double>(best) : 0.0;
}

}  // namespace asperity
