#include "find_rib_directions.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "asperity/signal/spectrum.h"
#include "spectrum_at.h"

namespace asperity {

namespace {

constexpr std::size_t kRibPadding = 4;                           // bins to an independent frequency, at least
constexpr double kPointsOfShortest = 4.0;                        // that the shortest wave still has
constexpr std::size_t kNearestBeside = 2, kFarthestBeside = 16;  // independent frequencies beside a wave
constexpr double kLeastRibShare = 1.0 / 32.0;                    // as LineSearch has it
constexpr std::size_t kRibCandidates = 4;
constexpr double kSteepestRibs = 1.0;
constexpr int kRibRefinements = 5;
constexpr double kMostRibHeights = 33'554'432.0;  // 2^25: heights times directions, some seconds

struct RibPeak {
  double tangent, ratio;
  std::size_t bin;
};

// What is searched in each direction: the periodogram of the heights, coarsely.
class RibSearch {
 public:
  RibSearch(const BentPath& path, std::span<const double> height_m, double spacing_m, const TextureNoise& noise,
            double shortest_m, double longest_m)
      : path_(path), height_m_(height_m), spacing_m_(spacing_m) {
    group_ = std::max<std::size_t>(1, static_cast<std::size_t>(shortest_m / kPointsOfShortest / spacing_m));
    const std::size_t groups = height_m.size() / group_;
    while (size_ < kRibPadding * groups) size_ *= 2;
    bins_each_ = static_cast<double>(size_) / static_cast<double>(std::max<std::size_t>(1, groups));
    padding_ = static_cast<std::size_t>(bins_each_);
    length_m_ = static_cast<double>(size_ * group_) * spacing_m;
    for (std::size_t k = 0; k <= size_ / 2; ++k)
      noise_.push_back(spectrum_at(noise.frequency_cycles_per_mm, noise.added_psd_m2_mm, 1e-3 * frequency_per_m(k)));
    first_ = std::max<std::size_t>(2, static_cast<std::size_t>(std::ceil(length_m_ / longest_m)));
    last_ = static_cast<std::size_t>(length_m_ / shortest_m);
  }

  double frequency_per_m(std::size_t bin) const { return static_cast<double>(bin) / length_m_; }

  // In m²/(cycles/mm), by bins of 1/length.
  std::vector<double> periodogram(double tangent) const {
    const std::vector<double> even_m = path_.straightened(height_m_, tangent);
    const std::size_t n = even_m.size() / group_;
    std::vector<double> x(size_, 0.0);
    double sum = 0.0, points = 0.0;
    std::vector<double> counts(n, 0.0);
    for (std::size_t i = 0; i < n * group_; ++i) {
      if (!std::isfinite(even_m[i])) continue;
      x[i / group_] += even_m[i];
      counts[i / group_] += 1.0;
      sum += even_m[i];
      points += 1.0;
    }
    if (points == 0.0) return {};
    double present = 0.0;
    for (std::size_t i = 0; i < n; ++i) {
      x[i] = counts[i] > 0.0 ? x[i] / counts[i] - sum / points : 0.0;
      present += counts[i] > 0.0 ? 1.0 : 0.0;
    }
    std::vector<double> out;
    for (const std::complex<double>& line : real_dft(x))
      out.push_back(2e3 * spacing_m_ * static_cast<double>(group_) * std::norm(line) / present);
    return out;
  }

  // The wave that stands out most, of those with a pattern's share of the power; a ratio of 0 if there is none.
  RibPeak find_peak(double tangent) const {
    const std::vector<double> power = periodogram(tangent);
    RibPeak out{tangent, 0.0, 0};
    std::vector<double> sums(power.size() + 1, 0.0);
    double surface = 0.0;
    for (std::size_t k = 0; k < power.size(); ++k) {
      sums[k + 1] = sums[k] + power[k];
      if (k > 0) surface += std::max(0.0, power[k] - noise_[k]) / bins_each_;
    }
    for (std::size_t k = first_; k <= last_ && k + 1 < power.size(); ++k) {
      if (power[k] < power[k - 1] || power[k] < power[k + 1] || power[k] < kLeastRibShare * surface) continue;
      const std::size_t near = kNearestBeside * padding_, far = kFarthestBeside * padding_;
      const std::size_t from = k > far ? k - far : 1, before = k > near ? k - near : 1;
      const std::size_t after = std::min(k + near, power.size()), to = std::min(k + far, power.size());
      const double beside = sums[before] - sums[from] + sums[to] - sums[after];
      const double count = static_cast<double>(before - from + to - after);
      const double density = std::max(noise_[k], count > 0.0 ? beside / count : 0.0);
      if (density > 0.0 && power[k] > out.ratio * density) out = {tangent, power[k] / density, k};
    }
    return out;
  }

  // The tangent near the peak's at which its wave has most power.
  double refined(const RibPeak& peak, double step) const {
    const auto power_at = [&](double tangent) {
      if (!path_.crosses(tangent)) return 0.0;
      const std::vector<double> power = periodogram(tangent);
      const auto from = power.begin() + static_cast<std::ptrdiff_t>(peak.bin > padding_ ? peak.bin - padding_ : 1);
      return *std::max_element(
          from, power.begin() + static_cast<std::ptrdiff_t>(std::min(peak.bin + padding_ + 1, power.size())));
    };
    double best = peak.tangent, most = power_at(best);
    for (int round = 0; round < kRibRefinements; ++round) {
      step *= 0.5;
      for (const double tangent : {best - step, best + step}) {
        const double power = power_at(tangent);
        if (power <= most) continue;
        most = power;
        best = tangent;
        break;
      }
    }
    return best;
  }

 private:
  const BentPath& path_;
  std::span<const double> height_m_;
  double spacing_m_ = 0.0;
  std::vector<double> noise_;
  std::size_t size_ = 1, padding_ = 1, group_ = 1, first_ = 0, last_ = 0;
  double bins_each_ = 1.0;  // to an independent frequency; padding_ is its whole part
  double length_m_ = 0.0;   // padded
};

}  // namespace

RibDirections find_rib_directions(const BentPath& path, std::span<const double> height_m, double spacing_m,
                                  const TextureNoise& noise, const PeriodicityConfig& config) {
  RibDirections out;
  const double longest_m = std::min(config.max_pitch_m, spacing_m * static_cast<double>(height_m.size()) / 3.0);
  if (!(longest_m > config.min_pitch_m)) return out;
  // The directions grow with the path's bend, and so with its length: of a wild path of 20 m there would be 80,000.
  const double finest = path.step_of_direction(config.min_pitch_m);
  const double step = std::max(finest, 2.0 * kSteepestRibs * static_cast<double>(height_m.size()) / kMostRibHeights);
  const double shortest_m = config.min_pitch_m * step / finest;
  if (!(longest_m > shortest_m)) return out;
  const RibSearch directions(path, height_m, spacing_m, noise, shortest_m, longest_m);
  const int reach = static_cast<int>(kSteepestRibs / step);
  std::vector<RibPeak> peaks;
  double lowest = kSteepestRibs, highest = -kSteepestRibs;
  for (int k = -reach; k <= reach; ++k) {
    const double tangent = step * k;
    if (!path.crosses(tangent)) continue;
    lowest = std::min(lowest, tangent);
    highest = std::max(highest, tangent);
    const RibPeak peak = directions.find_peak(tangent);
    if (peak.ratio > 0.0) peaks.push_back(peak);
  }
  out.range = std::max(0.0, highest - lowest);
  std::sort(peaks.begin(), peaks.end(), [](const RibPeak& a, const RibPeak& b) { return a.ratio > b.ratio; });
  std::vector<RibPeak> chosen;
  for (const RibPeak& peak : peaks) {
    // A wave that stands out does so in the directions beside its own too.
    const bool same = std::any_of(chosen.begin(), chosen.end(), [&](const RibPeak& other) {
      const std::size_t apart = std::max(peak.bin, other.bin) - std::min(peak.bin, other.bin);
      return apart <= kFarthestBeside * kRibPadding / 4;
    });
    if (same) continue;
    chosen.push_back(peak);
    if (chosen.size() == kRibCandidates) break;
  }
  for (const RibPeak& peak : chosen) {
    const double radians = 2.0 * std::numbers::pi * directions.frequency_per_m(peak.bin) * path.bend_rms_m();
    out.best.push_back({directions.refined(peak, step), 1.0 / (radians * std::sqrt(2.0 * peak.ratio))});
  }
  return out;
}

}  // namespace asperity
