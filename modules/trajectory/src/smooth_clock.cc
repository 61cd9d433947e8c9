#include "asperity/trajectory/smooth_clock.h"

#include <algorithm>
#include <cmath>

namespace asperity {

namespace {

// Stamps more regular than this share of their period are kept: smoothing them gains nothing.
constexpr double kRegular = 0.01;

// Stamps without any clock behind them lie 1/√12 = 0.29 of a period (RMS) from the nearest of its ticks.
constexpr double kUnexplained = 0.26;

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

// Samples that arrive in batches: the stamps in a batch are regular, and each batch as a whole is early or late by as
// much as several periods. Such stamps have a clock behind them however large their scatter is.
constexpr double kStepOfBatch = 0.25;    // a step within this share of the usual one is inside of a batch
constexpr double kLeastInBatches = 0.6;  // share of such steps
constexpr double kLongSpan_s = 0.1;      // over which the period is taken: many batches, few losses
constexpr double kShiftSpan_s = 0.15;    // before and after a gap, to tell lost samples from a late batch
constexpr double kLeastLost = 2.0;       // periods
constexpr double kSureSpreads =
    2.5;  // interquartile ranges of the waits: medians of few batches scatter by half of one

bool in_batches(const std::vector<std::int64_t>& t_ns) {
  const double usual = median_step_ns(t_ns);
  std::size_t inside = 0;
  for (std::size_t i = 0; i + 1 < t_ns.size(); ++i)
    inside += std::abs(static_cast<double>(t_ns[i + 1] - t_ns[i]) - usual) <= kStepOfBatch * usual ? 1 : 0;
  return static_cast<double>(inside) >= kLeastInBatches * static_cast<double>(t_ns.size() - 1);
}

double quantile_of(std::vector<double>& x, double share) {
  const auto at = x.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(x.size() - 1));
  std::nth_element(x.begin(), at, x.end());
  return *at;
}

double median_of(std::vector<double>& x) { return quantile_of(x, 0.5); }

// The median over long spans: neither a late batch nor a loss is in most of them.
double long_period_ns(const std::vector<std::int64_t>& t_ns) {
  const double usual = median_step_ns(t_ns);
  const std::size_t span =
      std::clamp<std::size_t>(static_cast<std::size_t>(kLongSpan_s * 1e9 / usual), 1, t_ns.size() / 2);
  std::vector<double> steps;
  for (std::size_t i = 0; i + span < t_ns.size(); ++i)
    steps.push_back(static_cast<double>(t_ns[i + span] - t_ns[i]) / static_cast<double>(span));
  return median_of(steps);
}

// Each sample is one period after the one before, but across a gap whose two sides lie further apart for good: a batch
// that is late is followed by others that are not. What is after the gap ends with the next one, for that may be a
// loss.
std::vector<double> count_in_batches(const std::vector<std::int64_t>& t_ns, double period) {
  const std::size_t n = t_ns.size();
  const auto reach = static_cast<std::size_t>(std::max(8.0, kShiftSpan_s * 1e9 / period));
  std::vector<double> count(n, 0.0), side;
  const auto is_gap = [&](std::size_t i) {
    return static_cast<double>(t_ns[i] - t_ns[i - 1]) > (kLeastLost + 0.5) * period;
  };
  for (std::size_t i = 1; i < n; ++i) {
    count[i] = count[i - 1] + 1.0;
    if (!is_gap(i)) continue;
    side.clear();
    for (std::size_t j = i; j < std::min(n, i + reach) && (j < i + reach / 4 || !is_gap(j)); ++j)
      side.push_back(static_cast<double>(t_ns[j] - t_ns[i]) - period * static_cast<double>(j - i));
    const double after = median_of(side);
    side.clear();
    for (std::size_t j = i > reach ? i - reach : 0; j < i; ++j)
      side.push_back(static_cast<double>(t_ns[j] - t_ns[i]) - period * (count[j] - count[i]));
    const double before = median_of(side);
    const double spread = quantile_of(side, 0.75) - quantile_of(side, 0.25);
    const double shift = after - before;
    if (shift > std::max(kLeastLost * period, kSureSpreads * spread)) count[i] += std::round(shift / period);
  }
  return count;
}

// The slope of the least-squares line of stamp over count, in periods.
double mean_step(const std::vector<std::int64_t>& t_ns, const std::vector<double>& count, double period) {
  const double middle = 0.5 * count.back();
  double sxx = 0.0, sxy = 0.0, sx = 0.0, sy = 0.0;
  for (std::size_t i = 0; i < t_ns.size(); ++i) {
    const double x = count[i] - middle, y = static_cast<double>(t_ns[i] - t_ns[0]) / period - count[i];
    sx += x, sy += y, sxx += x * x, sxy += x * y;
  }
  const auto n = static_cast<double>(t_ns.size());
  return 1.0 + (sxy - sx * sy / n) / (sxx - sx * sx / n);
}

// Counts periods with a loop that follows the stamps' phase and, slowly, the period itself.
std::vector<double> count_periods(const std::vector<std::int64_t>& t_ns, double& period) {
  constexpr double kPhaseGain = 0.05;
  constexpr double kPeriodGain = 0.0005;
  std::vector<double> count(t_ns.size(), 0.0);
  double phase = 0.0;  // the loop's time of the last sample, ns after the first
  for (std::size_t i = 1; i < t_ns.size(); ++i) {
    const auto t = static_cast<double>(t_ns[i] - t_ns[0]);
    const double steps = std::max(1.0, std::round((t - phase) / period));
    const double error = t - (phase + steps * period);
    phase += steps * period + kPhaseGain * error;
    period += kPeriodGain * error / steps;
    count[i] = count[i - 1] + steps;
  }
  return count;
}

struct Line {
  std::vector<std::int64_t> t_ns;
  double jitter_ns = 0.0;
  bool rises = true;
};

// The local straight line of stamp over count.
Line follow_line(const std::vector<std::int64_t>& t_ns, const std::vector<double>& count, double period,
                 double window_s) {
  // Sums relative to the straight line of the nominal period keep their digits over hours.
  const std::size_t n = t_ns.size();
  std::vector<double> residual(n);
  for (std::size_t i = 0; i < n; ++i) residual[i] = static_cast<double>(t_ns[i] - t_ns[0]) - count[i] * period;
  const double half_window = 0.5 * window_s * 1e9 / period;
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
  const bool rises = std::adjacent_find(smooth.begin(), smooth.end(), std::greater_equal<>()) == smooth.end();
  return {std::move(smooth), std::sqrt(square / static_cast<double>(n)), rises};
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

  const std::vector<double> count = count_periods(t_ns, period);
  Line line = follow_line(t_ns, count, period, config.window_s);
  bool explained = line.rises && line.jitter_ns <= kUnexplained * period;
  if (!explained && in_batches(t_ns)) {
    period = long_period_ns(t_ns);
    period *= mean_step(t_ns, count_in_batches(t_ns, period), period);
    line = follow_line(t_ns, count_in_batches(t_ns, period), period, config.window_s);
    explained = line.rises;
  }
  result.jitter_s = line.jitter_ns * 1e-9;
  if (!explained) return result;
  result.t_ns = std::move(line.t_ns);
  result.period_s = period * 1e-9;
  result.applied = true;
  return result;
}

}  // namespace asperity
