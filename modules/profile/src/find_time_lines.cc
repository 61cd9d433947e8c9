#include "asperity/profile/find_time_lines.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <optional>
#include <vector>

#include "asperity/base/nan.h"
#include "asperity/signal/chi_square.h"
#include "asperity/signal/resample.h"
#include "asperity/signal/spectrum.h"
#include "asperity/signal/statistics.h"
#include "passed_windows.h"
#include "rib_ordinates.h"

namespace asperity {

namespace {

constexpr double kWindow_s = 8.0;        // the mains keep their frequency to 0.1 Hz over it
constexpr double kFast = 4.0;            // of the median speed: faster parts do not set the sampling
constexpr std::size_t kPadding = 4;      // ordinates between two independent ones
constexpr std::size_t kNeighbours = 24;  // independent ordinates to each side by which one is judged
constexpr std::size_t kOwn = 3;          // next to a line: its own
constexpr std::size_t kSide = 6;         // independent ordinates from a found line on in which it is searched no more
constexpr double kFalseAlarm = 1e-3;     // of a profile without lines
constexpr double kTwice = 2.0;           // the power over time by that over the path
constexpr double kLeastLeft = 0.3;       // of a path's line, by the errors of places: less, nothing is concluded
constexpr double kLeastAbove = 3.0;      // the mean of the neighbours, however many windows
constexpr double kLeastShare = 5e-3;     // of the heights' power
constexpr std::size_t kMostTried = 64;   // peaks

// The mean squares of waves that ordinates stand for, over evenly spaced frequencies from 0: 2 |Σ w x e^(…)|² / (Σ w)².
struct Ordinates {
  double step = 0.0;
  std::vector<double> power_m2;
};

// The heights over `at` (time or path), linear between points, times their weights; nan heights are gaps, which count
// for nothing. `length` is the number of samples at the padding's end.
std::vector<double> windowed_ordinates(const std::vector<double>& at, const std::vector<double>& weight,
                                       const std::vector<double>& height_m, double spacing, std::size_t length) {
  const auto count = static_cast<std::size_t>((at.back() - at.front()) / spacing) + 1;
  std::vector<double> weighted(at.size());
  for (std::size_t i = 0; i < at.size(); ++i) weighted[i] = weight[i] * height_m[i];
  std::vector<double> x = resample_uniform(at, weighted, at.front(), spacing, count);
  const std::vector<double> w = resample_uniform(at, weight, at.front(), spacing, count);
  double sum = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    if (std::isfinite(x[i])) {
      sum += w[i];
    } else {
      x[i] = 0.0;
    }
  }
  x.resize(length, 0.0);
  std::vector<double> out;
  for (const std::complex<double>& ordinate : real_dft(x)) out.push_back(2.0 * std::norm(ordinate) / (sum * sum));
  return out;
}

struct Periodograms {
  Ordinates time, path;
};

void add(const std::vector<double>& from, std::vector<double>& to) {
  to.resize(from.size(), 0.0);
  for (std::size_t i = 0; i < from.size(); ++i) to[i] += from[i];
}

// Samples of a window and its padding.
std::size_t padded(double samples) { return smooth_length(kPadding * (static_cast<std::size_t>(samples) + 2)); }

Periodograms mean_periodograms(const PassedWindows& passed) {
  Periodograms out;
  double longest_m = 0.0;
  for (const PassedWindow& w : passed.windows) longest_m = std::max(longest_m, w.s_m.back() - w.s_m.front());
  // Samples of time are those of points at a fast part, but no more than four times as many as there are points.
  const double spacing_s = passed.spacing_m / std::min(passed.fast_mps, kFast * passed.typical_mps);
  const std::size_t time_length = padded(passed.length_s / spacing_s);
  const std::size_t path_length = padded(longest_m / passed.spacing_m);
  out.time.step = 1.0 / (spacing_s * static_cast<double>(time_length));
  out.path.step = 1.0 / (passed.spacing_m * static_cast<double>(path_length));
  for (const PassedWindow& w : passed.windows) {
    add(windowed_ordinates(w.t_s, w.weight, w.height_m, spacing_s, time_length), out.time.power_m2);
    add(windowed_ordinates(w.s_m, w.weight, w.height_m, passed.spacing_m, path_length), out.path.power_m2);
  }
  for (Ordinates* of : {&out.time, &out.path}) {
    for (double& power_m2 : of->power_m2) power_m2 /= static_cast<double>(passed.windows.size());
  }
  return out;
}

// The mean ordinate of the spectrum about place i, by the medians to both sides: the higher, for spectra fall.
double mean_about(const std::vector<double>& power, std::size_t i, std::size_t independent, double median_by_mean) {
  const std::size_t own = kOwn * independent, reach = (kOwn + kNeighbours) * independent;
  const std::span<const double> all(power);
  const auto side = [&](std::size_t first, std::size_t last) {
    return last > first ? median(all.subspan(first, last - first)) : 0.0;
  };
  return std::max(side(i > reach ? i - reach : 0, i > own ? i - own : 0),
                  side(std::min(i + own + 1, power.size()), std::min(i + reach + 1, power.size()))) /
         median_by_mean;
}

double highest_between(const Ordinates& of, double low, double high) {
  const auto first = static_cast<std::size_t>(std::max(0.0, std::floor(low / of.step)));
  const auto last = std::min(of.power_m2.size(), static_cast<std::size_t>(std::ceil(high / of.step)) + 1);
  double out = 0.0;
  for (std::size_t i = first; i < last; ++i) out = std::max(out, of.power_m2[i]);
  return out;
}

}  // namespace

std::vector<TimeLine> find_time_lines(const Profile& profile, std::span<const double> height_m, double place_sigma_m,
                                      std::span<const Eigen::Vector2d> unrolled_m) {
  std::vector<TimeLine> out;
  const PassedWindows passed = find_passed_windows(profile, height_m, unrolled_m, kWindow_s);
  if (passed.windows.empty() || !(passed.mean_square_m2 > 0.0)) return out;
  const Periodograms p = mean_periodograms(passed);

  const std::vector<double>& power = p.time.power_m2;
  const double per_ordinate_Hz = 1.0 / passed.length_s;
  const auto independent = static_cast<std::size_t>(std::max(1.0, std::round(per_ordinate_Hz / p.time.step)));
  // Where four points make a wave, straight lines between points take 0.34 of its power.
  const double highest_Hz = 0.25 * passed.typical_mps / profile.spacing_m;
  const std::size_t first = (kOwn + kNeighbours) * independent;
  const std::size_t last = std::min(power.size() - 1, static_cast<std::size_t>(highest_Hz / p.time.step));
  if (last <= first) return out;
  const double tried = static_cast<double>(last - first) / static_cast<double>(independent);
  const double freedom = 2.0 * static_cast<double>(passed.windows.size());
  const double median_by_mean = chi_square_quantile(0.5, freedom) / freedom;
  const double limit = std::max(kLeastAbove, chi_square_quantile(1.0 - kFalseAlarm / tried, freedom) / freedom);
  const bool bends = bends_over_ribs(unrolled_m, profile.spacing_m);
  // A wave of the path whose places err by place_sigma_m has less of its power in one ordinate.
  const auto left_on_path = [&](double frequency_Hz) {
    const double turns = frequency_Hz / passed.typical_mps * place_sigma_m;
    return std::exp(-std::pow(2.0 * std::numbers::pi * turns, 2));
  };

  std::vector<std::size_t> peaks;
  for (std::size_t i = first; i < last; ++i) {
    if (power[i] > power[i - 1] && power[i] >= power[i + 1] && power[i] > kLeastShare * passed.mean_square_m2)
      peaks.push_back(i);
  }
  std::sort(peaks.begin(), peaks.end(), [&](std::size_t a, std::size_t b) { return power[a] > power[b]; });
  peaks.resize(std::min(peaks.size(), kMostTried));
  std::vector<std::size_t> found;
  for (const std::size_t i : peaks) {
    const bool beside = std::any_of(found.begin(), found.end(), [&](std::size_t of) {
      return std::max(i, of) - std::min(i, of) <= kSide * independent;
    });
    const double about = mean_about(power, i, independent, median_by_mean);
    const bool narrow =
        std::max(power[i - kOwn * independent], power[std::min(i + kOwn * independent, last)]) < 0.5 * power[i];
    if (beside || !narrow || !(power[i] > limit * about)) continue;
    const double frequency_Hz = static_cast<double>(i) * p.time.step;
    const double on_path = highest_between(p.path, frequency_Hz / passed.fast_mps, frequency_Hz / passed.slow_mps);
    if (power[i] * kTwice < on_path) continue;
    found.push_back(i);
    const double left = left_on_path(frequency_Hz);
    bool of_time = left > kLeastLeft && power[i] * left >= kTwice * on_path;
    if (of_time && bends) {
      const std::optional<double> of_ribs = highest_of_ribs(passed, frequency_Hz);
      of_time = of_ribs && power[i] * left >= kTwice * *of_ribs;
    }
    out.push_back({frequency_Hz, per_ordinate_Hz, std::sqrt(power[i] - about), !of_time});
  }
  return out;
}

}  // namespace asperity
