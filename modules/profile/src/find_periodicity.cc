#include "asperity/profile/find_periodicity.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

#include "asperity/base/error.h"
#include "asperity/base/plausible_profile.h"
#include "asperity/base/text.h"
#include "asperity/signal/statistics.h"
#include "follow_pattern.h"
#include "line_search.h"
#include "period_depths.h"

namespace asperity {

namespace {

constexpr int kHarmonics = 4;
constexpr std::size_t kSearchPoints = 10000;  // a longer profile adds nothing to the search, only to the phase's line
constexpr double kReachOfLag = 0.03;          // as far as the lag's parabola may be off
constexpr double kTwoPi = 2.0 * std::numbers::pi;

// The mean product at a lag over the mean square of the same points, gaps left out.
double autocorrelation(std::span<const double> x, std::size_t lag) {
  double xy = 0.0, xx = 0.0, yy = 0.0;
  for (std::size_t i = 0; i + lag < x.size(); ++i) {
    const double a = x[i], b = x[i + lag];
    if (!std::isfinite(a) || !std::isfinite(b)) continue;
    xy += a * b;
    xx += a * a;
    yy += b * b;
  }
  return xx > 0.0 && yy > 0.0 ? xy / std::sqrt(xx * yy) : 0.0;
}

// Sum of x exp(-2πi f k) over the points [from, to), with f in cycles a point.
std::complex<double> transform_at(std::span<const double> x, double f, std::size_t from, std::size_t to) {
  constexpr std::size_t kLanes = 4;  // points at once, each with a phasor of its own
  constexpr std::size_t kRenewed = 256;
  using Four [[gnu::vector_size(32)]] = double;
  // Not by std::complex, whose product looks for infinities.
  const std::complex<double> step = std::polar(1.0, -kTwoPi * std::fmod(f * static_cast<double>(kLanes), 1.0));
  Four re{}, im{}, sum_re{}, sum_im{};
  for (std::size_t k = from; k < to; k += kLanes) {
    // Renewed now and then: the product's rounding errors add up.
    const bool renew = (k - from) % kRenewed == 0;
    Four value{};
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      if (renew) {
        const auto at = static_cast<double>(k + lane);
        const std::complex<double> phasor = std::polar(1.0, -kTwoPi * std::fmod(f * at, 1.0));
        re[lane] = phasor.real();
        im[lane] = phasor.imag();
      }
      if (k + lane < to && std::isfinite(x[k + lane])) value[lane] = x[k + lane];
    }
    sum_re += value * re;
    sum_im += value * im;
    const Four turned = re * step.real() - im * step.imag();
    im = re * step.imag() + im * step.real();
    re = turned;
  }
  return {(sum_re[0] + sum_re[1]) + (sum_re[2] + sum_re[3]), (sum_im[0] + sum_im[1]) + (sum_im[2] + sum_im[3])};
}

double harmonic_power(std::span<const double> x, double f) {
  double power = 0.0;
  for (int h = 1; h <= kHarmonics && h * f < 0.5; ++h) power += std::norm(transform_at(x, h * f, 0, x.size()));
  return power;
}

// The lag of the shortest prominent peak, in points and refined by a parabola; 0 if there is none.
double find_lag(std::span<const double> x, std::size_t shortest, std::size_t longest) {
  std::vector<double> r(longest + 2);
  for (std::size_t lag = 0; lag < r.size(); ++lag) r[lag] = autocorrelation(x, lag);
  double highest = 0.0;
  std::vector<std::size_t> peaks;
  for (std::size_t lag = std::max<std::size_t>(1, shortest); lag <= longest; ++lag) {
    if (r[lag] >= r[lag - 1] && r[lag] > r[lag + 1] && r[lag] > 0.0) {
      peaks.push_back(lag);
      highest = std::max(highest, r[lag]);
    }
  }
  for (const std::size_t lag : peaks) {
    if (r[lag] < 0.85 * highest) continue;
    const double bend = r[lag - 1] - 2.0 * r[lag] + r[lag + 1];
    return static_cast<double>(lag) + (bend < 0.0 ? 0.5 * (r[lag - 1] - r[lag + 1]) / bend : 0.0);
  }
  return 0.0;
}

// The frequency near `f` whose harmonics hold most power, searched over a relative distance of `relative_reach`.
double refine_frequency(std::span<const double> x, double f, double relative_reach) {
  // Steps of an eighth of the resolution.
  const double step = 0.125 / static_cast<double>(x.size());
  double best = f, most = harmonic_power(x, f);
  const int reach = static_cast<int>(std::clamp(relative_reach * f / step, 4.0, 64.0));
  for (int k = -reach; k <= reach; ++k) {
    const double power = harmonic_power(x, f + k * step);
    if (power > most) {
      most = power;
      best = f + k * step;
    }
  }
  const double before = harmonic_power(x, best - step), after = harmonic_power(x, best + step);
  // At the end of the search the power may still rise: a parabola through a flank has its top anywhere.
  if (before > most || after > most) return best;
  const double bend = before - 2.0 * most + after;
  return bend < 0.0 ? best + 0.5 * step * (before - after) / bend : best;
}

// In noise the peak at twice or thrice the period may happen to be the highest. Where the correlation is so weak that
// noise decides, the shortest of these periods is taken whose harmonics hold as much power as those of the long one.
double undo_multiple(std::span<const double> x, double f) {
  constexpr double kClear = 0.6;
  constexpr double kReachInNoise = 0.06;
  if (autocorrelation(x, static_cast<std::size_t>(std::lround(1.0 / f))) >= kClear) return f;
  const double power = harmonic_power(x, f);
  for (const int multiple : {4, 3, 2}) {
    const double shorter = refine_frequency(x, multiple * f, kReachInNoise);
    if (shorter < 0.5 && harmonic_power(x, shorter) >= power) return shorter;
  }
  return f;
}

// Corrects f by the drift of the fundamental's phase and gives its standard error, relative.
double follow_phase(std::span<const double> x, double& f) {
  const auto window = static_cast<std::size_t>(std::lround(2.0 / f));
  std::vector<double> centre, phase;
  double last = 0.0;
  for (std::size_t from = 0; from + window <= x.size(); from += window) {
    std::size_t finite = 0;
    for (std::size_t k = from; k < from + window; ++k) finite += std::isfinite(x[k]) ? 1 : 0;
    if (static_cast<double>(finite) < 0.7 * static_cast<double>(window)) continue;
    const double angle = std::arg(transform_at(x, f, from, from + window));
    last = phase.empty() ? angle : last + std::remainder(angle - last, kTwoPi);
    centre.push_back(static_cast<double>(from) + 0.5 * static_cast<double>(window));
    phase.push_back(last);
  }
  if (centre.size() < 3) return std::numeric_limits<double>::quiet_NaN();
  const LinearFit line = linear_regression(centre, phase);
  double square = 0.0, product = 0.0, before = 0.0;
  for (std::size_t i = 0; i < centre.size(); ++i) {
    const double residual = phase[i] - line.slope * centre[i] - line.intercept;
    square += residual * residual;
    if (i > 0) product += residual * before;
    before = residual;
  }
  const double r = square > 0.0 ? std::clamp(product / square, 0.0, 0.9) : 0.0;
  f += line.slope / kTwoPi;
  return line.slope_error / kTwoPi * std::sqrt((1.0 + r) / (1.0 - r)) / f;
}

}  // namespace

namespace {

// The stretch of at most kSearchPoints with the fewest gaps.
std::span<const double> search_part(std::span<const double> x) {
  if (x.size() <= kSearchPoints) return x;
  std::size_t finite = 0;
  for (std::size_t k = 0; k < kSearchPoints; ++k) finite += std::isfinite(x[k]) ? 1 : 0;
  std::size_t most = finite, best = 0;
  for (std::size_t k = kSearchPoints; k < x.size(); ++k) {
    finite += std::isfinite(x[k]) ? 1 : 0;
    finite -= std::isfinite(x[k - kSearchPoints]) ? 1 : 0;
    if (finite > most) {
      most = finite;
      best = k + 1 - kSearchPoints;
    }
  }
  return x.subspan(best, kSearchPoints);
}

// Of heights without their mean, from a first frequency in cycles a point.
Periodicity follow_from(std::span<const double> x, double spacing_m, double f, const PeriodicityConfig& config) {
  Periodicity out;
  const double relative = follow_phase(x, f);
  const double period = 1.0 / f;
  out.pitch_m = spacing_m * period;
  out.pitch_stderr_m = out.pitch_m * relative;
  out.strength = autocorrelation(x, static_cast<std::size_t>(std::lround(period)));

  const std::vector<double> depths = period_depths(x, period);
  out.periods = depths.size();
  if (!depths.empty()) {
    out.depth_m = median(depths);
    // The standard error of a median of normal values is √(π/2) that of their mean.
    out.depth_stderr_m = std::sqrt(0.5 * std::numbers::pi / static_cast<double>(depths.size())) * kSigmaPerMad *
                         median_absolute_deviation(depths);
  }
  out.periodic = out.strength >= config.min_strength && out.periods >= 3;
  return out;
}

// Less the mean over one period about each point, at the ends the first and the last whole one: a pattern has none in
// it, and keeps all of its harmonics; longer waves go.
void subtract_running_mean(std::size_t period, std::vector<double>& x) {
  std::vector<double> sums(x.size() + 1, 0.0), counts(x.size() + 1, 0.0);
  for (std::size_t i = 0; i < x.size(); ++i) {
    const bool present = std::isfinite(x[i]);
    sums[i + 1] = sums[i] + (present ? x[i] : 0.0);
    counts[i + 1] = counts[i] + (present ? 1.0 : 0.0);
  }
  for (std::size_t i = 0; i < x.size(); ++i) {
    const std::size_t from = std::min(i - std::min(i, period / 2), x.size() - period);
    const double count = counts[from + period] - counts[from];
    if (count > 0.0) x[i] -= (sums[from + period] - sums[from]) / count;
  }
}

// The heights without their mean; empty if there are too few.
std::vector<double> without_mean(std::span<const double> height_m) {
  double sum = 0.0, count = 0.0;
  for (const double h : height_m) {
    if (!std::isfinite(h)) continue;
    sum += h;
    count += 1.0;
  }
  if (count < 16.0) return {};
  std::vector<double> x(height_m.begin(), height_m.end());
  for (double& h : x) h -= sum / count;
  return x;
}

}  // namespace

std::vector<double> period_depths(std::span<const double> x, double period) {
  std::vector<double> out;
  for (double from = 0.0; from + period <= static_cast<double>(x.size()); from += period) {
    double low = std::numeric_limits<double>::infinity(), high = -low, finite = 0.0;
    for (auto k = static_cast<std::size_t>(from); k < static_cast<std::size_t>(from + period); ++k) {
      if (!std::isfinite(x[k])) continue;
      low = std::min(low, x[k]);
      high = std::max(high, x[k]);
      finite += 1.0;
    }
    if (finite > 0.7 * period) out.push_back(high - low);
  }
  return out;
}

Periodicity follow_pattern(std::span<const double> height_m, double spacing_m, double pitch_m,
                           const PeriodicityConfig& config) {
  std::vector<double> x = without_mean(height_m);
  const auto period = static_cast<std::size_t>(std::lround(pitch_m / spacing_m));
  if (x.empty() || period < 2 || period > x.size()) return {};
  for (int k = 0; k < 2; ++k) subtract_running_mean(period, x);
  return follow_from(x, spacing_m, refine_frequency(search_part(x), spacing_m / pitch_m, kReachOfLag), config);
}

Periodicity find_repetition(std::span<const double> height_m, double spacing_m, const PeriodicityConfig& config) {
  require_plausible_spacing(spacing_m, "periodicity");
  require_plausible_heights(height_m, "periodicity");
  if (!(config.min_pitch_m > 2.0 * spacing_m) || !(config.max_pitch_m > config.min_pitch_m)) {
    throw Error("periodicity: spacing " + number_text(spacing_m) + " m, pitch " + number_text(config.min_pitch_m) +
                " to " + number_text(config.max_pitch_m) + " m");
  }
  Periodicity out;
  const auto shortest = static_cast<std::size_t>(config.min_pitch_m / spacing_m);
  const auto longest = std::min(static_cast<std::size_t>(config.max_pitch_m / spacing_m), height_m.size() / 3);
  const std::vector<double> x = without_mean(height_m);
  if (x.empty() || longest <= shortest) return out;

  const std::span<const double> part = search_part(x);
  const double lag = find_lag(part, shortest, std::min(longest, part.size() / 3));
  if (!(lag > 0.0)) return out;
  return follow_from(x, spacing_m, undo_multiple(part, refine_frequency(part, 1.0 / lag, kReachOfLag)), config);
}

Periodicity find_periodicity(std::span<const double> height_m, double spacing_m, const PeriodicityConfig& config) {
  Periodicity out = find_repetition(height_m, spacing_m, config);
  if (!out.periodic) return out;
  const double longest_m = std::min(config.max_pitch_m, spacing_m * static_cast<double>(height_m.size()) / 3.0);
  out.periodic = LineSearch(height_m, spacing_m, {}, {}, 1.0, config.min_pitch_m, longest_m).has_pattern(out.pitch_m);
  return out;
}

}  // namespace asperity
