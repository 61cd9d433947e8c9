#include "asperity/import/stroke_windows.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "asperity/signal/zero_phase.h"

namespace asperity {

namespace {

constexpr double kMoving_mps = 0.010, kRest_mps = 0.002, kCreeping_mps = 0.002;
constexpr double kAway_s = 0.1, kShortest_s = 0.25;
constexpr double kJudgedFrom_Hz = 40.0, kJudgedWindow_s = 0.05;
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

// Whole windows in which all samples are marked.
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

std::vector<char> active_samples(const Stroke& stroke, double speed_mps) {
  std::vector<char> out(stroke.size(), 1);
  for (std::size_t i = 0; i < out.size(); ++i) {
    if (stroke.speed_is_measured && !(stroke.speed_mps[i] > speed_mps)) out[i] = 0;
    if (stroke.force_is_measured && !(stroke.force_N[i] >= stroke.contact_N)) out[i] = 0;
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

struct Mean {
  double value = 0.0, sigma = 0.0;
};

Mean mean_of(const std::vector<double>& values) {
  Mean out;
  const auto n = static_cast<double>(values.size());
  for (const double v : values) out.value += v / n;
  for (const double v : values) out.sigma += (v - out.value) * (v - out.value);
  out.sigma = n > 1.0 ? std::sqrt(out.sigma / (n * (n - 1.0))) : out.value;
  return out;
}

std::vector<double> powers_of(std::span<const double> x, const std::vector<std::size_t>& firsts, std::size_t length) {
  std::vector<double> out;
  for (const std::size_t first : firsts) out.push_back(power_of(x, first, length));
  return out;
}

// A straight line through the logarithms of power and speed.
void fit_growth(const Stroke& stroke, std::span<const double> x, std::size_t length, StrokeEvidence& out) {
  std::vector<double> speed, power;
  for (const std::size_t first : marked_windows(active_samples(stroke, kCreeping_mps), length)) {
    const double p = power_of(x, first, length);
    if (!(p > 0.0)) continue;
    double mean = 0.0;
    for (std::size_t i = first; i < first + length; ++i) mean += stroke.speed_mps[i] / static_cast<double>(length);
    if (!(mean > 0.0)) continue;
    speed.push_back(std::log(mean));
    power.push_back(std::log(p));
  }
  constexpr std::size_t kLeastWindows = 10;
  constexpr double kLeastSpread = 0.2;
  const auto n = static_cast<double>(speed.size());
  if (speed.size() < kLeastWindows) return;
  const double mean_x = std::accumulate(speed.begin(), speed.end(), 0.0) / n;
  const double mean_y = std::accumulate(power.begin(), power.end(), 0.0) / n;
  double xx = 0.0, xy = 0.0, residuals = 0.0;
  for (std::size_t i = 0; i < speed.size(); ++i) {
    xx += (speed[i] - mean_x) * (speed[i] - mean_x);
    xy += (speed[i] - mean_x) * (power[i] - mean_y);
  }
  if (std::sqrt(xx / n) < kLeastSpread) return;
  out.speed_exponent = xy / xx;
  for (std::size_t i = 0; i < speed.size(); ++i)
    residuals += std::pow(power[i] - mean_y - out.speed_exponent * (speed[i] - mean_x), 2);
  out.speed_exponent_sigma = std::sqrt(2.0 * residuals / ((n - 2.0) * xx));
}

}  // namespace

StrokeWindows find_stroke_windows(const Stroke& stroke, std::span<const double> acceleration_mps2, double window_s) {
  StrokeWindows out;
  out.length = std::max(kLeastSamples, static_cast<std::size_t>(std::round(window_s * stroke.rate_Hz)));
  out.active = marked_windows(active_samples(stroke, kMoving_mps), out.length);
  const auto away = static_cast<std::size_t>(std::round(kAway_s * stroke.rate_Hz));
  const auto is_enough = [&] {
    return static_cast<double>(out.quiet.size() * out.length) >= kShortest_s * stroke.rate_Hz * (1.0 - 1e-9);
  };
  if (stroke.speed_is_measured) {
    out.quiet = marked_windows(calm_samples(stroke.speed_mps, kRest_mps, away), out.length);
    out.quiet_is = StrokeQuiet::kRest;
  }
  if (stroke.force_is_measured && !is_enough()) {
    out.quiet = marked_windows(calm_samples(stroke.force_N, 0.5 * stroke.contact_N, away), out.length);
    out.quiet_is = StrokeQuiet::kAir;
  }
  if (!stroke.speed_is_measured && !stroke.force_is_measured) {
    out.quiet.clear();
    part_by_power(out, acceleration_mps2, stroke.rate_Hz);
  }
  if (!is_enough()) {
    out.quiet.clear();
    out.quiet_is = StrokeQuiet::kNone;
  }
  return out;
}

StrokeEvidence measure_stroke_evidence(const Stroke& stroke) {
  StrokeEvidence out;
  out.has_speed = stroke.speed_is_measured;
  out.has_force = stroke.force_is_measured;
  out.contact_N = stroke.contact_N;
  for (std::size_t i = 0; i < stroke.size(); ++i) {
    if (out.has_speed) out.largest_speed_mps = std::max(out.largest_speed_mps, stroke.speed_mps[i]);
    if (!out.has_force) continue;
    out.largest_force_N = std::max(out.largest_force_N, stroke.force_N[i]);
    if (stroke.force_N[i] >= stroke.contact_N) out.contact_s += 1.0 / stroke.rate_Hz;
    if (stroke.force_N[i] < 0.5 * stroke.contact_N) out.free_s += 1.0 / stroke.rate_Hz;
  }
  const std::vector<double> x =
      zero_phase_highpass(stroke.acceleration_mps2, std::max(kJudgedFrom_Hz, stroke.high_pass_Hz), stroke.rate_Hz);
  const StrokeWindows windows = find_stroke_windows(stroke, x, kJudgedWindow_s);
  const double window_s = static_cast<double>(windows.length) / stroke.rate_Hz;
  out.active_s = window_s * static_cast<double>(windows.active.size());
  out.quiet_s = window_s * static_cast<double>(windows.quiet.size());
  out.moving_s = out.has_speed ? out.active_s : 0.0;
  if (out.active_s < kShortest_s) return out;
  const Mean active = mean_of(powers_of(x, windows.active, windows.length));
  out.active_mps2 = std::sqrt(active.value);
  Mean quiet = mean_of(powers_of(x, windows.quiet, windows.length));
  out.quiet = windows.quiet_is;
  if (stroke.noise_mps2 > 0.0 && (out.quiet == StrokeQuiet::kNone || out.quiet == StrokeQuiet::kQuietest)) {
    out.quiet = StrokeQuiet::kStated;
    quiet = {stroke.noise_mps2 * stroke.noise_mps2, 0.0};
  }
  if (out.quiet == StrokeQuiet::kNone) {
    if (out.has_speed) fit_growth(stroke, x, windows.length, out);
    return out;
  }
  out.quiet_mps2 = std::sqrt(quiet.value);
  if (!(active.value > 0.0)) {  // all that the filter leaves is rounding
    out.power_ratio = out.power_ratio_sigma = 0.0;
  } else {
    // A made-up stroke is silent at rest: rounding stands for it.
    const double floor = std::max(quiet.value, 1e-12 * active.value);
    out.power_ratio = active.value / floor;
    out.power_ratio_sigma = out.power_ratio * std::hypot(active.sigma / active.value, quiet.sigma / floor);
  }
  return out;
}

}  // namespace asperity
