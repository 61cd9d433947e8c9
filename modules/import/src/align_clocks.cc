#include "asperity/import/align_clocks.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>

#include <fmt/format.h>
#include "asperity/signal/spectrum.h"
#include "asperity/signal/statistics.h"
#include "motion_curves.h"
#include "pose_at.h"

namespace asperity {

namespace {

// What one of the curves needs to say something.
struct CurveKind {
  const char* name;          // how the clocks are aligned
  double least;              // RMS about its mean
  double least_slope_per_s;  // RMS in a window: below, noise decides
  bool needs_share;          // of knocks one alone agrees with any other: c falls with what is outside of the overlap
  const char* too_little;
  const char* disagree;
};

constexpr CurveKind kRotation{
    "rotation", 0.1, 1.0, false, "there is too little rotation", "the angular speeds do not agree at any offset"};
constexpr CurveKind kAcceleration{"acceleration",
                                  0.3,
                                  10.0,
                                  true,
                                  "there is too little acceleration",
                                  "the accelerations do not agree at any offset"};

// Less its mean, 0 where there is nothing.
std::vector<double> centred(const std::vector<double>& x) {
  double sum = 0.0, count = 0.0;
  for (const double value : x) {
    if (std::isfinite(value)) sum += value, count += 1.0;
  }
  std::vector<double> out;
  for (const double value : x) out.push_back(std::isfinite(value) ? value - sum / std::max(count, 1.0) : 0.0);
  return out;
}

std::vector<double> energy_up_to(const std::vector<double>& x) {
  std::vector<double> out{0.0};
  for (const double value : x) out.push_back(out.back() + value * value);
  return out;
}

struct Peak {
  long lag = 0;  // grid steps by which the gyroscope's curve begins later
  double correlation = -1.0;
  double next = -1.0;  // the highest more than a second away
};

// c(l) = Σ p_i g_{i+l} / √(Σ p² Σ g²), sums over the overlap. With `needs_share` times √(s/0.8) where the larger of the
// two curves' shares of their squares that are in the overlap, s, is below 0.8.
Peak correlation_peak(const std::vector<double>& p, const std::vector<double>& g, bool needs_share) {
  std::size_t n = 1;
  while (n < p.size() + g.size()) n *= 2;
  std::vector<double> padded_p = p, padded_g = g;
  padded_p.resize(n);
  padded_g.resize(n);
  auto P = real_dft(padded_p);
  const auto G = real_dft(padded_g);
  for (std::size_t i = 0; i < P.size(); ++i) P[i] = std::conj(P[i]) * G[i];
  const std::vector<double> sums = inverse_real_dft(P, n);
  const std::vector<double> energy_p = energy_up_to(p), energy_g = energy_up_to(g);
  const auto np = static_cast<long>(p.size()), ng = static_cast<long>(g.size());
  const long least = std::max(std::min(np, ng) / 5, 2L);
  std::vector<double> correlation;
  const long first = -(np - least);
  for (long lag = first; lag <= ng - least; ++lag) {
    const long from = std::max(0L, -lag), to = std::min(np, ng - lag);
    const auto at = [](const std::vector<double>& x, long i) { return x[static_cast<std::size_t>(i)]; };
    const double of_p = at(energy_p, to) - at(energy_p, from), of_g = at(energy_g, to + lag) - at(energy_g, from + lag);
    const double sum = at(sums, lag < 0 ? lag + static_cast<long>(n) : lag);
    double c = of_p * of_g > 0.0 ? sum / std::sqrt(of_p * of_g) : 0.0;
    constexpr double kEnough = 0.8;
    const double share = std::max(of_p / energy_p.back(), of_g / energy_g.back());
    if (needs_share && share < kEnough) c *= std::sqrt(share / kEnough);
    correlation.push_back(c);
  }
  Peak out;
  if (correlation.empty()) return out;
  const auto best = std::max_element(correlation.begin(), correlation.end()) - correlation.begin();
  out.lag = first + static_cast<long>(best);
  out.correlation = correlation[static_cast<std::size_t>(best)];
  constexpr long kApart = static_cast<long>(1.0 / kCurveStep_s);
  for (long i = 0; i < static_cast<long>(correlation.size()); ++i) {
    if (std::abs(i - best) > kApart) out.next = std::max(out.next, correlation[static_cast<std::size_t>(i)]);
  }
  return out;
}

// An offset of the clocks (grid steps) with its standard error from what is left of the difference, which is correlated
// over the curves' own 40 ms; nan: not known.
struct WindowOffset {
  double steps = std::nan(""), sigma_steps = std::nan("");
};

// The offset at which g(i + offset) is nearest to p(i) for i in [from, to); not known if it does not settle near
// `start` or little happens.
WindowOffset window_offset(const std::vector<double>& p, const std::vector<double>& g, long from, long to, double start,
                           double least_slope_per_s) {
  constexpr int kSteps = 8;
  constexpr double kFar = 20.0, kLeastUse = 0.6;
  double offset = start, sigma = 0.0;
  for (int step = 0; step < kSteps; ++step) {
    double slope2 = 0.0, product = 0.0, square = 0.0;
    long used = 0;
    for (long i = from; i < to; ++i) {
      const double at = static_cast<double>(i) + offset;
      const long k = static_cast<long>(std::floor(at));
      if (k < 1 || k + 2 >= static_cast<long>(g.size())) continue;
      const auto K = static_cast<std::size_t>(k);
      const double share = at - static_cast<double>(k);
      const double value = g[K] + share * (g[K + 1] - g[K]);
      const double slope = 0.5 * ((1.0 - share) * (g[K + 1] - g[K - 1]) + share * (g[K + 2] - g[K]));
      const double error = p[static_cast<std::size_t>(i)] - value;
      if (!std::isfinite(error) || !std::isfinite(slope)) continue;
      slope2 += slope * slope;
      product += slope * error;
      square += error * error;
      ++used;
    }
    const double least = std::pow(least_slope_per_s * kCurveStep_s, 2) * static_cast<double>(std::max(used, 1L));
    if (static_cast<double>(used) < kLeastUse * static_cast<double>(to - from) || slope2 < least) return {};
    constexpr double kAlike = 8.0;  // points of the grid in 40 ms
    sigma = std::sqrt(kAlike * square / static_cast<double>(used) / slope2);
    const double change = product / slope2;
    offset += change;
    if (std::abs(offset - start) > kFar) return {};
  }
  return {offset, sigma};
}

double rms_of(const std::vector<double>& x) {
  double sum = 0.0, count = 0.0;
  for (const double value : x) {
    if (std::isfinite(value)) sum += value * value, count += 1.0;
  }
  return std::sqrt(sum / std::max(count, 1.0));
}

}  // namespace

std::int64_t ClockFit::imu_time_ns(std::int64_t pose_t_ns) const {
  // The offset may be that of an epoch: whole nanoseconds first.
  return pose_t_ns + std::llround(offset_s * 1e9) + std::llround(drift * static_cast<double>(pose_t_ns - middle_ns));
}

namespace {

// A window's offset by its own error, from the middle of all; s.
struct WindowTime {
  double middle_s, offset_s, sigma_s;
};

// A straight line through few windows, each by its own error, which the scatter about the line may widen.
void fit_weighted(const std::vector<WindowTime>& windows, double& at_s, double& fine_s, ClockFit& out) {
  double weights = 0.0, middle = 0.0, mean_s = 0.0;
  for (const WindowTime& w : windows) {
    const double weight = 1.0 / (w.sigma_s * w.sigma_s);
    weights += weight, middle += weight * w.middle_s, mean_s += weight * w.offset_s;
  }
  at_s = middle / weights;
  fine_s = mean_s / weights;
  double tt = 0.0, ty = 0.0;
  for (const WindowTime& w : windows) {
    const double weight = 1.0 / (w.sigma_s * w.sigma_s), t = w.middle_s - at_s;
    tt += weight * t * t, ty += weight * t * w.offset_s;
  }
  out.offset_sigma_s = 1.0 / std::sqrt(weights);
  if (windows.size() < 2) return;
  out.drift = ty / tt;
  out.drift_sigma = 1.0 / std::sqrt(tt);
  if (windows.size() < 3) return;
  double chi2 = 0.0;
  for (const WindowTime& w : windows)
    chi2 += std::pow((w.offset_s - fine_s - out.drift * (w.middle_s - at_s)) / w.sigma_s, 2);
  const double wider = std::sqrt(std::max(1.0, chi2 / static_cast<double>(windows.size() - 2)));
  out.offset_sigma_s *= wider;
  out.drift_sigma *= wider;
}

// A straight line through the windows, or their mean, by their scatter.
void fit_alike(const std::vector<WindowTime>& windows, double& at_s, double& fine_s, ClockFit& out) {
  std::vector<double> middle_s, offset_s;
  for (const WindowTime& w : windows) {
    middle_s.push_back(w.middle_s);
    offset_s.push_back(w.offset_s);
  }
  at_s = mean(middle_s);
  fine_s = mean(offset_s);
  out.offset_sigma_s = kCurveStep_s;
  constexpr std::size_t kLeastForDrift = 4;
  if (offset_s.size() >= kLeastForDrift) {
    for (double& t : middle_s) t -= at_s;
    const LinearFit line = linear_regression(middle_s, offset_s);
    fine_s = line.intercept;
    out.offset_sigma_s = line.intercept_error;
    out.drift = line.slope;
    out.drift_sigma = line.slope_error;
  } else if (offset_s.size() > 1) {
    out.offset_sigma_s = standard_deviation(offset_s) / std::sqrt(static_cast<double>(offset_s.size()));
  }
}

ClockFit align_curves(const MotionCurve& poses, const MotionCurve& sensor, const CurveKind& kind) {
  ClockFit out;
  out.by = kind.name;
  const auto not_determined = [&](std::string reason) {
    out.reason = std::move(reason);
    return out;
  };
  const std::vector<double> p = centred(poses.value), g = centred(sensor.value);
  if (rms_of(kind.needs_share ? p : poses.value) < kind.least) return not_determined(kind.too_little);
  const Peak peak = correlation_peak(p, g, kind.needs_share);
  out.correlation = peak.correlation;
  constexpr double kRelated = 0.8, kApart = 0.05;
  if (peak.correlation < kRelated)
    return not_determined(fmt::format("{} (correlation {:.2f})", kind.disagree, peak.correlation));
  if (peak.next > peak.correlation - kApart)
    return not_determined(fmt::format("the {} repeats itself: several offsets fit equally", kind.name));
  constexpr long kWindow = static_cast<long>(5.0 / kCurveStep_s);
  const auto points = static_cast<long>(poses.value.size());
  std::vector<WindowTime> windows;
  for (long from = 0; from < points; from += kWindow) {
    const long to = std::min(from + kWindow, points);
    if (from > 0 && to - from < kWindow / 2) break;
    const auto lag = static_cast<double>(peak.lag);
    const WindowOffset offset = window_offset(poses.value, sensor.value, from, to, lag, kind.least_slope_per_s);
    if (!std::isfinite(offset.steps)) continue;
    windows.push_back({0.5 * static_cast<double>(from + to) * kCurveStep_s, (offset.steps - lag) * kCurveStep_s,
                       std::max(offset.sigma_steps, 0.01) * kCurveStep_s});
  }
  if (windows.empty()) return not_determined(kind.too_little);
  // Relative to the two curves' beginnings, so that an epoch's digits stay whole.
  const std::int64_t whole_ns = sensor.start_ns - poses.start_ns + peak.lag * kCurveStep_ns;
  double at_s = 0.0, fine_s = 0.0;
  kind.needs_share ? fit_weighted(windows, at_s, fine_s, out) : fit_alike(windows, at_s, fine_s, out);
  // Straight lines between grid points, noisy ones too, move an offset by some 1 % of a step.
  constexpr double kInterpolation_s = kCurveStep_s / 50.0;
  out.offset_sigma_s = std::hypot(out.offset_sigma_s, kInterpolation_s);
  if (out.drift_sigma > 0.0) {
    // Of evenly spaced windows, as far apart as a uniform distribution's standard deviation.
    const double spread_s = (windows.back().middle_s - windows.front().middle_s) / std::sqrt(12.0);
    out.drift_sigma = std::hypot(out.drift_sigma, kInterpolation_s / spread_s);
  }
  out.middle_ns = poses.start_ns + std::llround(at_s * 1e9);
  out.offset_s = static_cast<double>(whole_ns) * 1e-9 + fine_s;
  out.is_determined = true;
  return out;
}

}  // namespace

ClockFit align_clocks(const PoseStream& pose, const VectorStream& rate, const VectorStream& specific_force,
                      const std::vector<Eigen::Vector3d>& ups) {
  constexpr std::size_t kFewest = 3;
  ClockFit best;
  best.reason = "the gyroscope is missing or the poses are too few";
  if (pose.size() < kFewest) return best;
  constexpr std::int64_t kHalf_ns = 20'000'000;
  const std::int64_t half_ns = std::max(kHalf_ns, median_interval_ns(pose.t_ns));
  if (rate.size() >= kFewest)
    best = align_curves(angular_speed(pose, half_ns), angular_speed(rate, half_ns), kRotation);
  if (best.is_determined || specific_force.size() < kFewest) return best;
  const MotionCurve felt = specific_force_size(specific_force, half_ns);
  ClockFit by_acceleration;
  for (const Eigen::Vector3d& up : ups) {
    ClockFit fit = align_curves(specific_force_size(pose, half_ns, up), felt, kAcceleration);
    const bool better = fit.is_determined != by_acceleration.is_determined
                            ? fit.is_determined
                            : fit.correlation > by_acceleration.correlation || by_acceleration.by.empty();
    if (better) by_acceleration = std::move(fit);
  }
  if (by_acceleration.is_determined) return by_acceleration;
  if (!by_acceleration.reason.empty()) best.reason += "; and " + by_acceleration.reason;
  return best;
}

}  // namespace asperity
