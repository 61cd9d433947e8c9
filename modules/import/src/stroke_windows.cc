#include "asperity/import/stroke_windows.h"

#include <algorithm>
#include <cmath>

namespace asperity {

namespace {

constexpr double kMoving_mps = 0.010, kRest_mps = 0.002;
constexpr double kAway_s = 0.1, kAwayInMotion_s = 0.05, kShortest_s = 0.25;
constexpr double kForceMean_s = 0.05;
constexpr std::size_t kLeastSamples = 64;

// The samples at which `value` is below `limit` and has been, and will be, for `away` samples; before the beginning and
// behind the end it is taken to be.
std::vector<char> calm_samples(const std::vector<double>& value, double limit, std::size_t away) {
  std::vector<char> out(value.size(), 1);
  std::size_t since = away;
  for (std::size_t i = 0; i < value.size(); ++i) {
    since = value[i] < limit ? since + 1 : 0;
    if (since <= away) out[i] = 0;
  }
  since = away;
  for (std::size_t i = value.size(); i-- > 0;) {
    since = value[i] < limit ? since + 1 : 0;
    if (since <= away) out[i] = 0;
  }
  return out;
}

// Means over kForceMean_s, less at the ends: a force that a rough surface and the sensor's noise shake.
std::vector<double> smooth_force(const Stroke& stroke) {
  const auto half = static_cast<std::size_t>(std::round(0.5 * kForceMean_s * stroke.rate_Hz));
  std::vector<double> sums{0.0};
  for (const double f : stroke.force_N) sums.push_back(sums.back() + f);
  std::vector<double> out;
  for (std::size_t i = 0; i < stroke.force_N.size(); ++i) {
    const std::size_t from = i > half ? i - half : 0, to = std::min(i + half + 1, stroke.force_N.size());
    out.push_back((sums[to] - sums[from]) / static_cast<double>(to - from));
  }
  return out;
}

double power_of(std::span<const double> x, std::size_t first, std::size_t length) {
  double sum = 0.0;
  for (std::size_t i = first; i < first + length; ++i) sum += x[i] * x[i];
  return sum / static_cast<double>(length);
}

// The quietest tenth and the louder half.
void part_by_power(StrokeWindows& out, std::span<const double> x, double rate_Hz) {
  constexpr std::size_t kLeastWindows = 10;
  std::vector<std::size_t> order = out.active;
  const auto least = static_cast<std::size_t>(std::ceil(kShortest_s * rate_Hz / static_cast<double>(out.length)));
  if (order.size() < kLeastWindows || order.size() < 4 * least) return;
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return power_of(x, a, out.length) < power_of(x, b, out.length);
  });
  const auto quiet = static_cast<std::ptrdiff_t>(std::max(least, order.size() / 10));
  out.quiet.assign(order.begin(), order.begin() + quiet);
  out.active.assign(order.begin() + static_cast<std::ptrdiff_t>(order.size() / 2), order.end());
  std::sort(out.quiet.begin(), out.quiet.end());
  std::sort(out.active.begin(), out.active.end());
  out.quiet_is = StrokeQuiet::kQuietest;
}

}  // namespace

std::vector<std::size_t> marked_windows(const std::vector<char>& marked, std::size_t length) {
  std::vector<std::size_t> out;
  std::size_t run = 0;
  for (std::size_t i = 0; i < marked.size(); ++i) {
    run = marked[i] != 0 ? run + 1 : 0;
    if (run < length) continue;
    out.push_back(i + 1 - length);
    run = 0;
  }
  return out;
}

std::vector<char> contact_samples(const Stroke& stroke) {
  std::vector<char> out(stroke.size(), 1);
  if (!stroke.force_is_measured) return out;
  const std::vector<double> force_N = smooth_force(stroke);
  const auto shortest = static_cast<std::size_t>(std::round(kShortest_s * stroke.rate_Hz));
  std::size_t run = 0;
  for (std::size_t i = 0; i <= out.size(); ++i) {
    if (i < out.size() && force_N[i] >= stroke.contact_N) {
      ++run;
      continue;
    }
    if (run < shortest)
      std::fill(out.begin() + static_cast<std::ptrdiff_t>(i - run), out.begin() + static_cast<std::ptrdiff_t>(i), 0);
    if (i < out.size()) out[i] = 0;
    run = 0;
  }
  return out;
}

std::vector<char> active_samples(const Stroke& stroke, double speed_mps) {
  std::vector<char> out = contact_samples(stroke);
  for (std::size_t i = 0; i < out.size(); ++i)
    if (stroke.speed_is_measured && !(stroke.speed_mps[i] > speed_mps)) out[i] = 0;
  return out;
}

StrokeWindows find_stroke_windows(const Stroke& stroke, std::span<const double> acceleration_mps2, double window_s) {
  StrokeWindows out;
  out.length = std::max(kLeastSamples, static_cast<std::size_t>(std::round(window_s * stroke.rate_Hz)));
  out.active = marked_windows(active_samples(stroke, kMoving_mps), out.length);
  const auto away = static_cast<std::size_t>(std::round(kAway_s * stroke.rate_Hz));
  const auto take_quiet = [&](const std::vector<char>& marked, StrokeQuiet kind) {
    out.quiet = marked_windows(marked, out.length);
    out.quiet_is = kind;
    return static_cast<double>(out.quiet.size() * out.length) >= kShortest_s * stroke.rate_Hz * (1.0 - 1e-9);
  };
  std::vector<double> force_N;
  if (stroke.force_is_measured) force_N = smooth_force(stroke);
  if (stroke.force_is_measured && stroke.speed_is_measured) {
    const auto near = static_cast<std::size_t>(std::round(kAwayInMotion_s * stroke.rate_Hz));
    std::vector<char> moving = calm_samples(force_N, 0.5 * stroke.contact_N, near);
    for (std::size_t i = 0; i < moving.size(); ++i)
      if (!(stroke.speed_mps[i] > kMoving_mps)) moving[i] = 0;
    if (take_quiet(moving, StrokeQuiet::kAirMotion)) return out;
  }
  if (stroke.speed_is_measured && take_quiet(calm_samples(stroke.speed_mps, kRest_mps, away), StrokeQuiet::kRest))
    return out;
  if (stroke.force_is_measured && take_quiet(calm_samples(force_N, 0.5 * stroke.contact_N, away), StrokeQuiet::kAir))
    return out;
  out.quiet.clear();
  out.quiet_is = StrokeQuiet::kNone;
  if (!stroke.speed_is_measured && !stroke.force_is_measured) part_by_power(out, acceleration_mps2, stroke.rate_Hz);
  return out;
}

}  // namespace asperity
