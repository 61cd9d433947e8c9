#include "passed_windows.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <utility>

#include "asperity/base/nan.h"
#include "asperity/signal/statistics.h"
#include "noise_blocks.h"

namespace asperity {

namespace {

constexpr double kSlow = 0.25;             // of the median speed: slower, the times of points are known too badly
constexpr double kLongestStep = 1.5;       // of the usual one, over the path and over time: beyond it is a gap
constexpr double kLeastFull = 0.5;         // of a window's time
constexpr std::size_t kFewestPoints = 64;  // of a window

struct Passed {
  std::vector<double> s_m, t_s, height_m, speed_mps;
  std::vector<Eigen::Vector2d> unrolled_m;
};

// The times of points; without the profile's own those through gaps are not known.
std::vector<double> times_of(const Profile& profile, double slow_mps) {
  if (profile.t_s.size() == profile.size()) {
    double last_s = -std::numeric_limits<double>::infinity();
    const bool rises = std::all_of(profile.t_s.begin(), profile.t_s.end(),
                                   [&](double t) { return !std::isfinite(t) || t >= std::exchange(last_s, t); });
    if (rises) return profile.t_s;
  }
  std::vector<double> out;
  double t_s = 0.0;
  for (const double v : profile.speed_mps) out.push_back(t_s += profile.spacing_m / (v > slow_mps ? v : slow_mps));
  return out;
}

Passed passed_points(const Profile& profile, std::span<const double> height_m,
                     std::span<const Eigen::Vector2d> unrolled_m) {
  std::vector<double> speeds;
  for (const double v : profile.speed_mps) {
    if (std::isfinite(v) && v > 0.0) speeds.push_back(v);
  }
  Passed out;
  if (speeds.empty()) return out;
  const double slow_mps = kSlow * median(speeds);
  const std::vector<double> t_s = times_of(profile, slow_mps);
  for (std::size_t i = 0; i < profile.size(); ++i) {
    const double v = profile.speed_mps[i];
    if (!(v > slow_mps) || !std::isfinite(v) || !std::isfinite(height_m[i]) || !std::isfinite(t_s[i])) continue;
    out.s_m.push_back(profile.s_m[i]);
    out.t_s.push_back(t_s[i]);
    out.height_m.push_back(height_m[i]);
    out.speed_mps.push_back(v);
    if (unrolled_m.size() == profile.size()) out.unrolled_m.push_back(unrolled_m[i]);
  }
  return out;
}

PassedWindow window_of(const Passed& passed, std::size_t first, std::size_t last, double begin_s,
                       const PassedWindows& all) {
  PassedWindow out;
  const double longest_m = kLongestStep * all.spacing_m, longest_s = longest_m / (kSlow * all.typical_mps);
  const auto add = [&](double s_m, double t_s, double height_m) {
    out.s_m.push_back(s_m);
    out.t_s.push_back(t_s);
    out.height_m.push_back(height_m);
    out.weight.push_back(1.0 - std::cos(2.0 * std::numbers::pi * (t_s - begin_s) / all.length_s));
  };
  for (std::size_t i = first; i < last; ++i) {
    const double s_m = passed.s_m[i], t_s = passed.t_s[i];
    if (i > first && (s_m - passed.s_m[i - 1] > longest_m || t_s - passed.t_s[i - 1] > longest_s)) {
      add(0.5 * (s_m + passed.s_m[i - 1]), 0.5 * (t_s + passed.t_s[i - 1]), kNan);
      if (!passed.unrolled_m.empty()) out.unrolled_m.push_back(passed.unrolled_m[i]);
    }
    add(s_m, t_s, passed.height_m[i]);
    if (!passed.unrolled_m.empty()) out.unrolled_m.push_back(passed.unrolled_m[i]);
  }
  return out;
}

}  // namespace

PassedWindows find_passed_windows(const Profile& profile, std::span<const double> height_m,
                                  std::span<const Eigen::Vector2d> unrolled_m, double longest_s) {
  PassedWindows out;
  if (profile.speed_mps.size() != profile.size() || height_m.size() != profile.size()) return out;
  const Passed passed = passed_points(profile, height_m, unrolled_m);
  const std::vector<double>& t_s = passed.t_s;
  if (t_s.size() < kFewestPoints || !(t_s.back() > t_s.front())) return out;
  out.length_s = std::min(longest_s, t_s.back() - t_s.front());
  out.spacing_m = profile.spacing_m;
  out.slow_mps = percentile(passed.speed_mps, 5.0);
  out.typical_mps = median(passed.speed_mps);
  out.fast_mps = percentile(passed.speed_mps, 95.0);
  out.mean_square_m2 = mean_square(passed.height_m);
  const double halves = std::max(2.0, std::floor(2.0 * (t_s.back() - t_s.front()) / out.length_s));
  if (!(halves < 4.0 * static_cast<double>(t_s.size()) / static_cast<double>(kFewestPoints))) return out;
  for (double half = 0.0; half + 1.0 < halves; half += 1.0) {
    const double begin_s = t_s.front() + 0.5 * half * out.length_s;
    const auto first = std::lower_bound(t_s.begin(), t_s.end(), begin_s) - t_s.begin();
    const auto last = std::upper_bound(t_s.begin(), t_s.end(), begin_s + out.length_s) - t_s.begin();
    double of_points_s = 0.0;
    for (auto i = first; i < last; ++i) of_points_s += out.spacing_m / passed.speed_mps[static_cast<std::size_t>(i)];
    if (last - first < static_cast<std::ptrdiff_t>(kFewestPoints) || of_points_s < kLeastFull * out.length_s) continue;
    out.windows.push_back(
        window_of(passed, static_cast<std::size_t>(first), static_cast<std::size_t>(last), begin_s, out));
  }
  return out;
}

}  // namespace asperity
