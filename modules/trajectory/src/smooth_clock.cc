#include "asperity/trajectory/smooth_clock.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "sample_clock.h"
#include "smooth_batches.h"

namespace asperity {

namespace {

// Stamps more regular than this share of their period are kept: smoothing them gains nothing.
constexpr double kRegular = 0.01;

// Stamps without any clock behind them lie 1/√12 = 0.29 of a period (RMS) from the nearest of its ticks.
constexpr double kUnexplained = 0.26;

// A batch waits as one: there are far fewer waits than samples to take the mean of.
constexpr double kBatchWindows = 2.0;

double median_step_ns(const std::vector<std::int64_t>& t_ns) {
  std::vector<std::int64_t> steps(t_ns.size() - 1);
  for (std::size_t i = 0; i + 1 < t_ns.size(); ++i) steps[i] = t_ns[i + 1] - t_ns[i];
  const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
  std::nth_element(steps.begin(), middle, steps.end());
  return static_cast<double>(*middle);
}

// The mean step of runs without losses. A median would be a whole tick of a coarse clock.
double period_ns(const std::vector<std::int64_t>& t_ns) {
  const double rough = median_step_ns(t_ns);
  double sum = 0.0;
  std::size_t count = 0;
  for (std::size_t i = 0; i + 1 < t_ns.size(); ++i) {
    const auto step = static_cast<double>(t_ns[i + 1] - t_ns[i]);
    if (step < 1.6 * rough) sum += step, ++count;
  }
  return count ? sum / static_cast<double>(count) : rough;
}

}  // namespace

SmoothClockResult smooth_clock(const std::vector<std::int64_t>& t_ns, const SmoothClockConfig& config) {
  SmoothClockResult result;
  result.t_ns = t_ns;
  if (t_ns.size() < 20) {
    if (t_ns.size() > 1) result.period_s = median_step_ns(t_ns) * 1e-9;
    return result;
  }
  double period = period_ns(t_ns);
  double scatter = 0.0;
  std::size_t steps_counted = 0;
  for (std::size_t i = 0; i + 1 < t_ns.size(); ++i) {
    const double step = static_cast<double>(t_ns[i + 1] - t_ns[i]);
    const double error = step - std::max(1.0, std::round(step / period)) * period;
    scatter += error * error;
    ++steps_counted;
  }
  scatter = std::sqrt(scatter / static_cast<double>(steps_counted));
  result.period_s = period * 1e-9;
  if (scatter < kRegular * period) return result;
  if (auto batches = smooth_batches(t_ns, kBatchWindows * config.window_s)) return *std::move(batches);

  const std::optional<SampleClock> found = find_sample_clock(t_ns);
  if (!found) return result;
  const std::vector<double>& count = found->count;
  period = found->period_ns;
  // Sums relative to the straight line of the nominal period keep their digits over hours.
  const std::size_t n = t_ns.size();
  std::vector<double> residual(n);
  for (std::size_t i = 0; i < n; ++i) residual[i] = static_cast<double>(t_ns[i] - t_ns[0]) - count[i] * period;
  const double half_window = 0.5 * config.window_s * 1e9 / period;
  std::vector<std::int64_t> smooth(n);
  double square = 0.0;
  std::size_t first = 0;
  std::size_t last = 0;  // one past the window
  double s0 = 0.0, sx = 0.0, sxx = 0.0, sy = 0.0, sxy = 0.0;
  double origin = 0.0;
  const auto add = [&](std::size_t i, double sign) {
    const double x = count[i] - origin;
    s0 += sign, sx += sign * x, sxx += sign * x * x, sy += sign * residual[i], sxy += sign * x * residual[i];
  };
  for (std::size_t i = 0; i < n; ++i) {
    if (count[i] - origin > 100.0 * half_window) {  // move the origin before the sums cancel
      origin = count[i];
      s0 = sx = sxx = sy = sxy = 0.0;
      for (std::size_t j = first; j < last; ++j) add(j, 1.0);
    }
    while (last < n && count[last] <= count[i] + half_window) add(last++, 1.0);
    while (count[first] < count[i] - half_window) add(first++, -1.0);
    const double x = count[i] - origin;
    const double determinant = s0 * sxx - sx * sx;
    const double fit = s0 < 3.0 || determinant <= 1e-9 * s0 * sxx
                           ? sy / s0
                           : (sy * sxx - sx * sxy + x * (s0 * sxy - sx * sy)) / determinant;
    smooth[i] = t_ns[0] + std::llround(count[i] * period + fit);
    square += (residual[i] - fit) * (residual[i] - fit);
  }
  result.jitter_s = std::sqrt(square / static_cast<double>(n)) * 1e-9;
  const bool rises = std::adjacent_find(smooth.begin(), smooth.end(), std::greater_equal<>()) == smooth.end();
  if (!rises || result.jitter_s * 1e9 > kUnexplained * period) return result;
  result.t_ns = std::move(smooth);
  result.period_s = period * 1e-9;
  result.applied = true;
  return result;
}

}  // namespace asperity
