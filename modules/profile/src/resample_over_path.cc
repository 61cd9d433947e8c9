#include "asperity/profile/resample_over_path.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <string>

#include "asperity/base/error.h"
#include "asperity/base/nan.h"
#include "asperity/base/text.h"

namespace asperity {

namespace {

constexpr std::size_t kMostPoints = 10'000'000;
constexpr int kFiner = 4;
constexpr int kHalfTaps = 32;  // eight cells of the profile to either side
constexpr std::size_t kTapCount = kHalfTaps + 1;

// A Blackman-windowed sinc at the fine spacing, its half gain at 0.4 of the coarse rate, sum one.
std::array<double, kTapCount> low_pass_taps() {
  std::array<double, kTapCount> taps{};
  constexpr double kCorner = 0.4 / kFiner;  // cycles a fine sample
  double sum = 0.0;
  for (int k = 0; k <= kHalfTaps; ++k) {
    const double x = 2.0 * std::numbers::pi * kCorner * k;
    const double a = std::numbers::pi * k / (kHalfTaps + 1);
    const double window = 0.42 + 0.5 * std::cos(a) + 0.08 * std::cos(2.0 * a);
    taps[static_cast<std::size_t>(k)] = window * (k == 0 ? 1.0 : std::sin(x) / x);
    sum += (k == 0 ? 1.0 : 2.0) * taps[static_cast<std::size_t>(k)];
  }
  for (double& tap : taps) tap /= sum;
  return taps;
}

// Second derivatives of the natural cubic spline through (s, x), by the tridiagonal recursion.
std::vector<double> spline_curvature(std::span<const double> s, std::span<const double> x) {
  const std::size_t n = s.size();
  std::vector<double> second(n, 0.0), upper(n, 0.0);
  for (std::size_t i = 1; i + 1 < n; ++i) {
    const double a = s[i] - s[i - 1], b = s[i + 1] - s[i];
    const double right = 6.0 * ((x[i + 1] - x[i]) / b - (x[i] - x[i - 1]) / a);
    const double pivot = 2.0 * (a + b) - a * upper[i - 1];
    upper[i] = b / pivot;
    second[i] = (right - a * second[i - 1]) / pivot;
  }
  for (std::size_t i = n - 1; i-- > 1;) second[i] -= upper[i] * second[i + 1];
  return second;
}

double spline_value(std::span<const double> s, std::span<const double> x, std::span<const double> second, std::size_t i,
                    double at) {
  const double h = s[i + 1] - s[i];
  const double b = (at - s[i]) / h, a = 1.0 - b;
  return a * x[i] + b * x[i + 1] + ((a * a * a - a) * second[i] + (b * b * b - b) * second[i + 1]) * h * h / 6.0;
}

// Calls run(begin, end) for each run of knots without a hole; `keep` selects the knots that count.
template <class Run>
void for_each_run(std::span<const double> s, double max_hole_m, Run run) {
  for (std::size_t begin = 0; begin < s.size();) {
    std::size_t end = begin + 1;
    while (end < s.size() && s[end] - s[end - 1] <= max_hole_m) ++end;
    run(begin, end);
    begin = end;
  }
}

void check_grid(std::size_t count, double spacing_m, double max_hole_m) {
  if (!(spacing_m > 0.0) || !(max_hole_m > 0.0)) {
    throw Error("resampling over the path: spacing " + number_text(spacing_m) + " m, largest hole " +
                number_text(max_hole_m) + " m; both must be positive");
  }
  if (count > kMostPoints) throw Error("resampling over the path: " + std::to_string(count) + " points are too many");
}

}  // namespace

std::size_t count_points(double length_m, double spacing_m) {
  const double count = std::floor(length_m / spacing_m * (1.0 + 1e-12)) + 1.0;
  if (!(count >= 1.0 && count <= static_cast<double>(kMostPoints))) {
    throw Error("a path of " + number_text(length_m) + " m has too many points at a spacing of " +
                number_text(spacing_m) + " m: at most " + std::to_string(kMostPoints) + " are allowed");
  }
  return static_cast<std::size_t>(count);
}

PathKnots gather_knots(std::span<const double> s_m, std::span<const std::span<const double>> channels,
                       std::span<const char> usable, double cell_m) {
  const std::size_t n = s_m.size();
  if (channels.empty() || !(cell_m > 0.0) || (!usable.empty() && usable.size() != n)) {
    throw Error("gather_knots: no channel, no cell width, or marks of another size");
  }
  for (const auto& channel : channels) {
    if (channel.size() != n)
      throw Error("gather_knots: a channel has " + std::to_string(channel.size()) + " samples, not " +
                  std::to_string(n));
  }
  std::vector<std::size_t> order;
  order.reserve(n);
  for (std::size_t i = 0; i < n; ++i) {
    if ((usable.empty() || usable[i] != 0) && std::isfinite(s_m[i]) && std::isfinite(channels[0][i]))
      order.push_back(i);
  }
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return s_m[a] < s_m[b]; });

  PathKnots out;
  out.channels.resize(channels.size());
  std::vector<double> sum(channels.size());
  std::vector<double> count(channels.size());
  for (std::size_t k = 0; k < order.size();) {
    // Cells begin at their first sample. The next sample is no nearer than cell_m to that, but the means
    // may be: then the cell is widened by half, so that two knots are never closer than that.
    double limit_m = s_m[order[k]] + cell_m;
    std::fill(sum.begin(), sum.end(), 0.0);
    std::fill(count.begin(), count.end(), 0.0);
    double sum_s = 0.0;
    double total = 0.0;
    const double origin_m = s_m[order[k]];
    for (bool widened = false; k < order.size(); ++k) {
      const std::size_t i = order[k];
      if (s_m[i] >= limit_m) {
        const double mean_m = origin_m + sum_s / total;
        if (widened || s_m[i] - mean_m >= 0.5 * cell_m) break;
        widened = true;
        limit_m = mean_m + 0.5 * cell_m;
        if (s_m[i] >= limit_m) break;
      }
      sum_s += s_m[i] - origin_m;
      total += 1.0;
      for (std::size_t c = 0; c < channels.size(); ++c) {
        if (!std::isfinite(channels[c][i])) continue;
        sum[c] += channels[c][i];
        count[c] += 1.0;
      }
    }
    out.s_m.push_back(origin_m + sum_s / total);
    for (std::size_t c = 0; c < channels.size(); ++c)
      out.channels[c].push_back(count[c] > 0.0 ? sum[c] / count[c] : kNan);
  }
  return out;
}

std::vector<double> resample_smooth(const PathKnots& knots, std::ptrdiff_t first, std::size_t count, double spacing_m,
                                    double max_hole_m) {
  check_grid(count, spacing_m, max_hole_m);
  static const std::array<double, kTapCount> taps = low_pass_taps();
  std::vector<double> out(count, kNan);
  const std::span<const double> all_s(knots.s_m), all_x(knots.channels[0]);
  std::vector<double> fine;
  for_each_run(all_s, max_hole_m, [&](std::size_t begin, std::size_t end) {
    const auto s = all_s.subspan(begin, end - begin), x = all_x.subspan(begin, end - begin);
    const auto from = std::max(static_cast<std::ptrdiff_t>(std::ceil(s.front() / spacing_m - 1e-9)), first);
    const auto to = std::min(static_cast<std::ptrdiff_t>(std::floor(s.back() / spacing_m + 1e-9)),
                             first + static_cast<std::ptrdiff_t>(count) - 1);
    if (s.size() < 3 || to < from) return;
    const std::vector<double> second = spline_curvature(s, x);
    // From the last fine point at or before the run's begin to the first at or after its end.
    const double step_m = spacing_m / kFiner;
    const auto fine_from = static_cast<std::ptrdiff_t>(std::ceil(s.front() / step_m - 1e-9));
    const auto fine_to = std::max(fine_from, static_cast<std::ptrdiff_t>(std::floor(s.back() / step_m + 1e-9)));
    const auto fine_count = static_cast<std::ptrdiff_t>(fine_to - fine_from + 1);
    fine.resize(static_cast<std::size_t>(fine_count));
    std::size_t i = 0;
    for (std::ptrdiff_t k = 0; k < fine_count; ++k) {
      const double at = step_m * static_cast<double>(fine_from + k);
      while (i + 2 < s.size() && s[i + 1] <= at) ++i;
      fine[static_cast<std::size_t>(k)] = spline_value(s, x, second, i, at);
    }
    // Odd reflection at the ends, as in the zero-phase filters, keeps level and slope there.
    const auto value = [&](std::ptrdiff_t k) {
      const std::ptrdiff_t last = fine_count - 1;
      if (k < 0) return 2.0 * fine.front() - fine[static_cast<std::size_t>(std::min(-k, last))];
      if (k > last)
        return 2.0 * fine.back() - fine[static_cast<std::size_t>(std::max<std::ptrdiff_t>(2 * last - k, 0))];
      return fine[static_cast<std::size_t>(k)];
    };
    for (std::ptrdiff_t k = from; k <= to; ++k) {
      const std::ptrdiff_t centre = kFiner * k - fine_from;
      double sum = taps[0] * value(centre);
      for (int j = 1; j <= kHalfTaps; ++j)
        sum += taps[static_cast<std::size_t>(j)] * (value(centre - j) + value(centre + j));
      out[static_cast<std::size_t>(k - first)] = sum;
    }
  });
  return out;
}

std::vector<double> resample_linear(const PathKnots& knots, std::size_t channel, std::ptrdiff_t first,
                                    std::size_t count, double spacing_m, double max_hole_m) {
  check_grid(count, spacing_m, max_hole_m);
  std::vector<double> s, x;
  for (std::size_t i = 0; i < knots.s_m.size(); ++i) {
    if (!std::isfinite(knots.channels[channel][i])) continue;
    s.push_back(knots.s_m[i]);
    x.push_back(knots.channels[channel][i]);
  }
  std::vector<double> out(count, kNan);
  std::size_t i = 0;
  for (std::size_t k = 0; k < count; ++k) {
    const double at = spacing_m * static_cast<double>(first + static_cast<std::ptrdiff_t>(k));
    while (i + 2 < s.size() && s[i + 1] < at) ++i;
    if (s.size() < 2 || at < s[i] - 1e-9 * spacing_m || at > s[i + 1] + 1e-9 * spacing_m ||
        s[i + 1] - s[i] > max_hole_m)
      continue;
    out[k] = x[i] + (at - s[i]) / (s[i + 1] - s[i]) * (x[i + 1] - x[i]);
  }
  return out;
}

}  // namespace asperity
