#include "asperity/profile/find_time_lines.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <numbers>
#include <vector>

#include "asperity/base/nan.h"
#include "asperity/signal/chi_square.h"
#include "asperity/signal/resample.h"
#include "asperity/signal/spectrum.h"
#include "asperity/signal/statistics.h"
#include "noise_blocks.h"

namespace asperity {

namespace {

constexpr double kWindow_s = 8.0;         // the mains keep their frequency to 0.1 Hz over it
constexpr double kSlow = 0.25;            // of the median speed: slower, the times of points are known too badly
constexpr double kFast = 4.0;             // likewise: faster parts do not set the sampling
constexpr std::size_t kPadding = 4;       // ordinates between two independent ones
constexpr std::size_t kNeighbours = 24;   // independent ordinates to each side by which one is judged
constexpr std::size_t kOwn = 3;           // next to a line: its own
constexpr std::size_t kSide = 6;          // independent ordinates from a found line on in which it is searched no more
constexpr double kFalseAlarm = 1e-3;      // of a profile without lines
constexpr double kTwice = 2.0;            // the power over time by that over the path
constexpr double kLeastShare = 5e-3;      // of the heights' power
constexpr std::size_t kMostTried = 64;    // peaks
constexpr std::size_t kLeastPoints = 64;  // of a window

// The points that count: with a height, and passed at a known speed.
struct Passed {
  std::vector<double> s_m, t_s, height_m, speed_mps;
};

Passed passed_points(const Profile& profile, std::span<const double> height_m) {
  std::vector<double> speeds;
  for (const double v : profile.speed_mps) {
    if (std::isfinite(v) && v > 0.0) speeds.push_back(v);
  }
  Passed out;
  if (speeds.empty()) return out;
  const double slow_mps = kSlow * median(speeds);
  double t_s = 0.0;
  for (std::size_t i = 0; i < profile.size(); ++i) {
    const double v = profile.speed_mps[i];
    t_s += profile.spacing_m / (v > slow_mps ? v : slow_mps);
    if (!(v > slow_mps) || !std::isfinite(height_m[i])) continue;
    out.s_m.push_back(profile.s_m[i]);
    out.t_s.push_back(t_s);
    out.height_m.push_back(height_m[i]);
    out.speed_mps.push_back(v);
  }
  return out;
}

// The mean squares of waves that ordinates stand for, over evenly spaced frequencies from 0: 2 |Σ w x e^(…)|² / (Σ w)².
struct Ordinates {
  double step = 0.0;
  std::vector<double> power_m2;
};

// The heights over `at` (time or path), linear between points, times a Hann window over the whole; gaps count for
// nothing. `length` is the number of samples at the padding's end.
std::vector<double> windowed_ordinates(const std::vector<double>& at, const std::vector<double>& weight,
                                       const std::vector<double>& height_m, double spacing, double longest_step,
                                       std::size_t length) {
  const auto count = static_cast<std::size_t>((at.back() - at.front()) / spacing) + 1;
  std::vector<double> weighted(at.size());
  for (std::size_t i = 0; i < at.size(); ++i) weighted[i] = weight[i] * height_m[i];
  std::vector<double> x = resample_uniform(at, weighted, at.front(), spacing, count, longest_step);
  const std::vector<double> w = resample_uniform(at, weight, at.front(), spacing, count, longest_step);
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
  double windows = 0.0;
  double window_s = 0.0;
};

void add(const std::vector<double>& from, std::vector<double>& to) {
  to.resize(from.size(), 0.0);
  for (std::size_t i = 0; i < from.size(); ++i) to[i] += from[i];
}

// Points [first, last) of a window that begins at begin_s.
struct Window {
  std::size_t first = 0, last = 0;
  double begin_s = 0.0;
};

// Windows that overlap by half, each with enough points; none where the tip is so slow that few have.
std::vector<Window> find_windows(const std::vector<double>& t_s, double window_s) {
  std::vector<Window> out;
  const double halves = std::max(2.0, std::floor(2.0 * (t_s.back() - t_s.front()) / window_s));
  if (!(halves < 4.0 * static_cast<double>(t_s.size()) / static_cast<double>(kLeastPoints))) return out;
  for (double half = 0.0; half + 1.0 < halves; half += 1.0) {
    const double begin_s = t_s.front() + 0.5 * half * window_s;
    const auto first = std::lower_bound(t_s.begin(), t_s.end(), begin_s) - t_s.begin();
    const auto last = std::upper_bound(t_s.begin(), t_s.end(), begin_s + window_s) - t_s.begin();
    if (last - first >= static_cast<std::ptrdiff_t>(kLeastPoints))
      out.push_back({static_cast<std::size_t>(first), static_cast<std::size_t>(last), begin_s});
  }
  return out;
}

// Samples of a window and its padding.
std::size_t padded(double samples) { return smooth_length(kPadding * (static_cast<std::size_t>(samples) + 2)); }

Periodograms mean_periodograms(const Passed& passed, double spacing_m) {
  Periodograms out;
  out.window_s = std::min(kWindow_s, passed.t_s.back() - passed.t_s.front());
  const std::vector<Window> windows = find_windows(passed.t_s, out.window_s);
  double longest_m = 0.0;
  for (const Window& w : windows) longest_m = std::max(longest_m, passed.s_m[w.last - 1] - passed.s_m[w.first]);
  // Samples of time are those of points at a fast part, but no more than four times as many as there are points.
  const double typical_mps = median(passed.speed_mps);
  const double fast_mps = std::min(percentile(passed.speed_mps, 95.0), kFast * typical_mps);
  const double spacing_s = spacing_m / fast_mps, longest_s = 2.5 * spacing_m / percentile(passed.speed_mps, 1.0);
  const std::size_t time_length = padded(out.window_s / spacing_s), path_length = padded(longest_m / spacing_m);
  out.time.step = 1.0 / (spacing_s * static_cast<double>(time_length));
  out.path.step = 1.0 / (spacing_m * static_cast<double>(path_length));
  for (const Window& w : windows) {
    const auto part = [&](const std::vector<double>& x) {
      return std::vector<double>(x.begin() + static_cast<std::ptrdiff_t>(w.first),
                                 x.begin() + static_cast<std::ptrdiff_t>(w.last));
    };
    const std::vector<double> s_m = part(passed.s_m), t_s = part(passed.t_s), height_m = part(passed.height_m);
    std::vector<double> weight;
    for (const double t : t_s)
      weight.push_back(1.0 - std::cos(2.0 * std::numbers::pi * (t - w.begin_s) / out.window_s));
    add(windowed_ordinates(t_s, weight, height_m, spacing_s, longest_s, time_length), out.time.power_m2);
    add(windowed_ordinates(s_m, weight, height_m, spacing_m, 1.5 * spacing_m, path_length), out.path.power_m2);
    out.windows += 1.0;
  }
  for (Ordinates* of : {&out.time, &out.path}) {
    for (double& power_m2 : of->power_m2) power_m2 /= out.windows;
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

std::vector<TimeLine> find_time_lines(const Profile& profile, std::span<const double> height_m) {
  std::vector<TimeLine> out;
  if (profile.speed_mps.size() != profile.size() || height_m.size() != profile.size()) return out;
  const Passed passed = passed_points(profile, height_m);
  if (passed.s_m.size() < kLeastPoints || !(passed.t_s.back() > passed.t_s.front())) return out;
  const double power_m2 = mean_square(passed.height_m);
  if (!(power_m2 > 0.0)) return out;
  const Periodograms p = mean_periodograms(passed, profile.spacing_m);
  if (!(p.windows > 0.0)) return out;

  const std::vector<double>& power = p.time.power_m2;
  const double per_ordinate_Hz = 1.0 / p.window_s;
  const auto independent = static_cast<std::size_t>(std::max(1.0, std::round(per_ordinate_Hz / p.time.step)));
  const double slow_mps = percentile(passed.speed_mps, 5.0), fast_mps = percentile(passed.speed_mps, 95.0);
  // Where four points make a wave, straight lines between points take 0.34 of its power.
  const double highest_Hz = 0.25 * median(passed.speed_mps) / profile.spacing_m;
  const std::size_t first = (kOwn + kNeighbours) * independent;
  const std::size_t last = std::min(power.size() - 1, static_cast<std::size_t>(highest_Hz / p.time.step));
  if (last <= first) return out;
  const double tried = static_cast<double>(last - first) / static_cast<double>(independent);
  const double freedom = 2.0 * p.windows;
  const double median_by_mean = chi_square_quantile(0.5, freedom) / freedom;
  const double limit = chi_square_quantile(1.0 - kFalseAlarm / tried, freedom) / freedom;

  std::vector<std::size_t> peaks;
  for (std::size_t i = first; i < last; ++i) {
    if (power[i] > power[i - 1] && power[i] >= power[i + 1] && power[i] > kLeastShare * power_m2) peaks.push_back(i);
  }
  std::sort(peaks.begin(), peaks.end(), [&](std::size_t a, std::size_t b) { return power[a] > power[b]; });
  peaks.resize(std::min(peaks.size(), kMostTried));
  std::vector<std::size_t> found;
  for (const std::size_t i : peaks) {
    const bool beside = std::any_of(found.begin(), found.end(), [&](std::size_t of) {
      return std::max(i, of) - std::min(i, of) <= kSide * independent;
    });
    const double about = mean_about(power, i, independent, median_by_mean);
    if (beside || !(power[i] > limit * about)) continue;
    const double frequency_Hz = static_cast<double>(i) * p.time.step;
    const double on_path = highest_between(p.path, frequency_Hz / fast_mps, frequency_Hz / slow_mps);
    if (power[i] * kTwice < on_path) continue;
    found.push_back(i);
    out.push_back({frequency_Hz, per_ordinate_Hz, std::sqrt(power[i] - about), power[i] < kTwice * on_path});
  }
  return out;
}

}  // namespace asperity
