#include "stream_timing.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "asperity/base/units.h"

namespace asperity {

namespace {

// Longer intervals hide a lost row: one and a half periods and, where the clock that wrote the stamps has
// ticks that the period is no multiple of, one tick.
double gap_threshold_ns(double period_ns, std::int64_t clock_step_ns) {
  const double ticks = period_ns / static_cast<double>(std::max<std::int64_t>(clock_step_ns, 1));
  const bool divides = std::abs(ticks - std::round(ticks)) < 0.02;
  return 1.5 * period_ns + (divides ? 0.0 : std::min(static_cast<double>(clock_step_ns), 0.5 * period_ns));
}

// The mean of the intervals that hide no loss. A coarse clock turns 2.5 ms into 2 and 3: the median
// alone would be 20 % off.
double loss_free_period_ns(const std::vector<std::int64_t>& intervals_ns, double median_ns,
                           std::int64_t clock_step_ns) {
  double period_ns = median_ns;
  for (int round = 0; round < 3; ++round) {
    double sum_ns = 0.0;
    std::size_t count = 0;
    for (const std::int64_t interval_ns : intervals_ns) {
      const auto value_ns = static_cast<double>(interval_ns);
      if (value_ns > gap_threshold_ns(period_ns, clock_step_ns)) continue;
      sum_ns += value_ns;
      ++count;
    }
    if (count > 0) period_ns = sum_ns / static_cast<double>(count);
  }
  return period_ns;
}

}  // namespace

StreamTiming stream_timing(const std::vector<std::int64_t>& t_ns) {
  StreamTiming out;
  out.count = t_ns.size();
  out.start_ns = t_ns.front();
  out.end_ns = t_ns.back();
  out.duration_s = static_cast<double>(out.end_ns - out.start_ns) * kNanosecond_s;
  if (t_ns.size() < 2) return out;

  std::vector<std::int64_t> intervals_ns(t_ns.size() - 1);
  for (std::size_t i = 0; i + 1 < t_ns.size(); ++i) {
    intervals_ns[i] = t_ns[i + 1] - t_ns[i];
    out.clock_step_ns = std::gcd(out.clock_step_ns, intervals_ns[i]);
  }
  const auto middle = intervals_ns.begin() + static_cast<std::ptrdiff_t>(intervals_ns.size() / 2);
  std::nth_element(intervals_ns.begin(), middle, intervals_ns.end());
  const auto median_ns = static_cast<double>(*middle);
  const double period_ns = loss_free_period_ns(intervals_ns, median_ns, out.clock_step_ns);
  out.median_rate_Hz = 1.0 / (median_ns * kNanosecond_s);
  out.mean_rate_Hz = static_cast<double>(intervals_ns.size()) / out.duration_s;
  out.period_s = period_ns * kNanosecond_s;

  double square_ns2 = 0.0;
  double lost = 0.0;
  std::size_t regular = 0;
  for (const std::int64_t interval_ns : intervals_ns) {
    const auto value_ns = static_cast<double>(interval_ns);
    if (value_ns > gap_threshold_ns(period_ns, out.clock_step_ns)) {
      ++out.gaps;
      out.longest_gap_s = std::max(out.longest_gap_s, value_ns * kNanosecond_s);
      lost += std::round(value_ns / period_ns) - 1.0;
    } else {
      ++regular;
      square_ns2 += (value_ns - period_ns) * (value_ns - period_ns);
    }
  }
  out.jitter_s = regular > 0 ? std::sqrt(square_ns2 / static_cast<double>(regular)) * kNanosecond_s : 0.0;
  out.lost = static_cast<std::size_t>(lost);
  out.lost_share = lost / (lost + static_cast<double>(out.count));
  return out;
}

}  // namespace asperity
