#include "asperity/import/measure_stroke_evidence.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>
#include <vector>

#include "asperity/import/stroke_windows.h"
#include "asperity/signal/student.h"
#include "asperity/signal/zero_phase.h"
#include "power_chance.h"

namespace asperity {

namespace {

constexpr double kCreeping_mps = 0.002, kShortest_s = 0.25;
constexpr double kJudgedFrom_Hz = 40.0, kJudgedWindow_s = 0.05;

double power_of(std::span<const double> x, std::size_t first, std::size_t length) {
  double sum = 0.0;
  for (std::size_t i = first; i < first + length; ++i) sum += x[i] * x[i];
  return sum / static_cast<double>(length);
}

WindowPowers powers_of(std::span<const double> x, const std::vector<std::size_t>& firsts, std::size_t length) {
  WindowPowers out{length, firsts, {}};
  for (const std::size_t first : firsts) out.power.push_back(power_of(x, first, length));
  return out;
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
  out.speed_exponent_margin =
      out.speed_exponent_sigma * student_quantile(1.0 - 2.0 * kStrokeFalseAlarm, std::max(1.0, 0.5 * n - 2.0));
}

// The ratio of the powers and its chance.
void compare_powers(const StrokeWindows& windows, const Stroke& stroke, std::span<const double> x,
                    StrokeEvidence& out) {
  const WindowPowers loud = powers_of(x, windows.active, windows.length);
  const WindowPowers calm = powers_of(x, windows.quiet, windows.length);
  const Mean active = mean_of(loud.power);
  Mean quiet = mean_of(calm.power);
  if (out.quiet == StrokeQuiet::kStated) quiet = {stroke.noise_mps2 * stroke.noise_mps2, 0.0};
  out.quiet_mps2 = std::sqrt(quiet.value);
  if (!(active.value > 0.0)) {  // all that the filter leaves is rounding
    out.power_ratio = out.power_ratio_sigma = 0.0;
    out.power_ratio_chance = 1.0;
    return;
  }
  // A made-up stroke is silent at rest: rounding stands for it.
  const double floor = std::max(quiet.value, 1e-12 * active.value);
  out.power_ratio = active.value / floor;
  out.power_ratio_sigma = out.power_ratio * std::hypot(active.sigma / active.value, quiet.sigma / floor);
  if (out.quiet == StrokeQuiet::kStated) {
    out.power_ratio_chance = power_chance(loud, quiet.value);
  } else if (out.quiet == StrokeQuiet::kQuietest) {
    const double window_s = static_cast<double>(windows.length) / stroke.rate_Hz;
    // The louder half and the quietest tenth are of all windows.
    out.power_ratio_chance = quietest_chance(out.power_ratio, 2 * windows.active.size(), windows.quiet.size(),
                                             power_freedom(x, stroke.rate_Hz, window_s));
  } else {
    out.power_ratio_chance = power_chance(loud, calm);
  }
}

}  // namespace

StrokeEvidence measure_stroke_evidence(const Stroke& stroke) {
  StrokeEvidence out;
  out.has_speed = stroke.speed_is_measured;
  out.has_force = stroke.force_is_measured;
  out.contact_N = stroke.contact_N;
  const std::vector<char> touches = contact_samples(stroke);
  for (std::size_t i = 0; i < stroke.size(); ++i) {
    if (out.has_speed) out.largest_speed_mps = std::max(out.largest_speed_mps, stroke.speed_mps[i]);
    if (!out.has_force) continue;
    out.largest_force_N = std::max(out.largest_force_N, stroke.force_N[i]);
    if (touches[i] != 0) out.contact_s += 1.0 / stroke.rate_Hz;
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
  out.active_mps2 = std::sqrt(mean_of(powers_of(x, windows.active, windows.length).power).value);
  out.quiet = windows.quiet_is;
  if (stroke.noise_mps2 > 0.0 && (out.quiet == StrokeQuiet::kNone || out.quiet == StrokeQuiet::kQuietest))
    out.quiet = StrokeQuiet::kStated;
  if (out.quiet == StrokeQuiet::kNone) {
    if (out.has_speed) fit_growth(stroke, x, windows.length, out);
    return out;
  }
  compare_powers(windows, stroke, x, out);
  return out;
}

}  // namespace asperity
