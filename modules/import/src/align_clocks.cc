#include "asperity/import/align_clocks.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>

#include <fmt/format.h>
#include "asperity/signal/spectrum.h"
#include "asperity/signal/statistics.h"
#include "pose_at.h"
#include "running_integral.h"

namespace asperity {

namespace {

constexpr std::int64_t kGrid_ns = 5'000'000;
constexpr double kGridStep_s = 5e-3;
constexpr std::size_t kMostGridPoints = std::size_t{1} << 24;  // a day

// Angular speed on a grid from the stream's first time on; nan where there is none.
struct SpeedCurve {
  std::int64_t start_ns = 0;
  std::vector<double> radps;
};

std::size_t grid_points(const std::vector<std::int64_t>& t_ns) {
  return std::min<std::size_t>(static_cast<std::size_t>((t_ns.back() - t_ns.front()) / kGrid_ns) + 1, kMostGridPoints);
}

SpeedCurve speed_of_poses(const PoseStream& pose, std::int64_t half_ns) {
  SpeedCurve out{pose.t_ns.front(), std::vector<double>(grid_points(pose.t_ns), std::nan(""))};
  PoseAt before(pose), after(pose);
  for (std::size_t i = 0; i < out.radps.size(); ++i) {
    const std::int64_t t_ns = out.start_ns + static_cast<std::int64_t>(i) * kGrid_ns;
    const auto a = before.interpolate(t_ns - half_ns), b = after.interpolate(t_ns + half_ns);
    if (a && b) out.radps[i] = rotation_between_rad(*a, *b) / (2e-9 * static_cast<double>(half_ns));
  }
  return out;
}

SpeedCurve speed_of_gyroscope(const VectorStream& rate, std::int64_t half_ns) {
  SpeedCurve out{rate.t_ns.front(), std::vector<double>(grid_points(rate.t_ns), std::nan(""))};
  const RunningIntegral turned(rate.t_ns, rate.value);
  for (std::size_t i = 0; i < out.radps.size(); ++i) {
    const std::int64_t t_ns = out.start_ns + static_cast<std::int64_t>(i) * kGrid_ns;
    if (const auto angle = turned.between(t_ns - half_ns, t_ns + half_ns)) {
      out.radps[i] = angle->norm() / (2e-9 * static_cast<double>(half_ns));
    }
  }
  return out;
}

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

// c(l) = Σ p_i g_{i+l} / √(Σ p² Σ g²), sums over the overlap.
Peak correlation_peak(const std::vector<double>& p, const std::vector<double>& g) {
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
    const double both = (at(energy_p, to) - at(energy_p, from)) * (at(energy_g, to + lag) - at(energy_g, from + lag));
    const double sum = at(sums, lag < 0 ? lag + static_cast<long>(n) : lag);
    correlation.push_back(both > 0.0 ? sum / std::sqrt(both) : 0.0);
  }
  Peak out;
  const auto best = std::max_element(correlation.begin(), correlation.end()) - correlation.begin();
  out.lag = first + static_cast<long>(best);
  out.correlation = correlation[static_cast<std::size_t>(best)];
  constexpr long kApart = static_cast<long>(1.0 / kGridStep_s);
  for (long i = 0; i < static_cast<long>(correlation.size()); ++i) {
    if (std::abs(i - best) > kApart) out.next = std::max(out.next, correlation[static_cast<std::size_t>(i)]);
  }
  return out;
}

// The offset (grid steps) at which g(i + offset) is nearest to p(i) for i in [from, to); nan if it does not settle near
// `start` or little happens.
double window_offset(const std::vector<double>& p, const std::vector<double>& g, long from, long to, double start) {
  constexpr int kSteps = 8;
  constexpr double kFar = 20.0, kLeastUse = 0.6;
  double offset = start;
  for (int step = 0; step < kSteps; ++step) {
    double slope2 = 0.0, product = 0.0;
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
      ++used;
    }
    // At least 1 rad/s² RMS: below, noise decides.
    const double least = std::pow(1.0 * kGridStep_s, 2) * static_cast<double>(std::max(used, 1L));
    if (static_cast<double>(used) < kLeastUse * static_cast<double>(to - from) || slope2 < least) return std::nan("");
    const double change = product / slope2;
    offset += change;
    if (std::abs(offset - start) > kFar) return std::nan("");
  }
  return offset;
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

ClockFit align_clocks(const PoseStream& pose, const VectorStream& rate) {
  ClockFit out;
  const auto not_determined = [&](std::string reason) {
    out.reason = std::move(reason);
    return out;
  };
  if (pose.size() < 3 || rate.size() < 3) return not_determined("there is no gyroscope or too few poses");
  constexpr std::int64_t kHalf_ns = 20'000'000;
  const std::int64_t half_ns = std::max(kHalf_ns, median_interval_ns(pose.t_ns));
  const SpeedCurve poses = speed_of_poses(pose, half_ns), gyro = speed_of_gyroscope(rate, half_ns);
  constexpr double kLeast_radps = 0.1;
  if (rms_of(poses.radps) < kLeast_radps) return not_determined("there is too little rotation");
  const Peak peak = correlation_peak(centred(poses.radps), centred(gyro.radps));
  out.correlation = peak.correlation;
  constexpr double kRelated = 0.8, kApart = 0.05;
  if (peak.correlation < kRelated) {
    return not_determined(
        fmt::format("the angular speeds do not agree at any offset (correlation {:.2f})", peak.correlation));
  }
  if (peak.next > peak.correlation - kApart) {
    return not_determined("the rotation repeats itself: several offsets fit equally");
  }
  constexpr long kWindow = static_cast<long>(5.0 / kGridStep_s);
  const auto points = static_cast<long>(poses.radps.size());
  std::vector<double> middle_s, offset_s;
  for (long from = 0; from < points; from += kWindow) {
    const long to = std::min(from + kWindow, points);
    if (from > 0 && to - from < kWindow / 2) break;
    const double offset = window_offset(poses.radps, gyro.radps, from, to, static_cast<double>(peak.lag));
    if (!std::isfinite(offset)) continue;
    middle_s.push_back(0.5 * static_cast<double>(from + to) * kGridStep_s);
    offset_s.push_back((offset - static_cast<double>(peak.lag)) * kGridStep_s);
  }
  if (offset_s.empty()) return not_determined("there is too little rotation");
  // Relative to the two curves' beginnings, so that an epoch's digits stay whole.
  const std::int64_t whole_ns = gyro.start_ns - poses.start_ns + peak.lag * kGrid_ns;
  double at_s = mean(middle_s), fine_s = mean(offset_s);
  out.offset_sigma_s = kGridStep_s;
  constexpr std::size_t kLeastForDrift = 4;
  if (offset_s.size() >= kLeastForDrift) {
    std::vector<double> from_middle;
    for (const double t : middle_s) from_middle.push_back(t - at_s);
    const LinearFit line = linear_regression(from_middle, offset_s);
    fine_s = line.intercept;
    out.offset_sigma_s = line.intercept_error;
    out.drift = line.slope;
    out.drift_sigma = line.slope_error;
  } else if (offset_s.size() > 1) {
    out.offset_sigma_s = standard_deviation(offset_s) / std::sqrt(static_cast<double>(offset_s.size()));
  }
  // Straight lines between grid points, noisy ones too, move an offset by some 1 % of a step.
  constexpr double kInterpolation_s = kGridStep_s / 50.0;
  out.offset_sigma_s = std::hypot(out.offset_sigma_s, kInterpolation_s);
  if (out.drift_sigma > 0.0) {
    // Of evenly spaced windows, as far apart as a uniform distribution's standard deviation.
    const double spread_s = (middle_s.back() - middle_s.front()) / std::sqrt(12.0);
    out.drift_sigma = std::hypot(out.drift_sigma, kInterpolation_s / spread_s);
  }
  out.middle_ns = poses.start_ns + std::llround(at_s * 1e9);
  out.offset_s = static_cast<double>(whole_ns) * 1e-9 + fine_s;
  out.is_determined = true;
  return out;
}

}  // namespace asperity
