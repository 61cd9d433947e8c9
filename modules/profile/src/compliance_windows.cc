#include "compliance_windows.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "asperity/base/units.h"
#include "asperity/signal/resample.h"
#include "asperity/signal/statistics.h"

namespace asperity {
namespace {

constexpr double kSpeedWindow_s = 0.2;  // over which a speed is taken: longer than a tracker's noise lasts
constexpr double kUsualSpeedPercentile = 80.0;
constexpr double kMovingPart = 0.5;      // of the usual speed: faster counts as a stroke
constexpr double kStationaryPart = 0.2;  // slower counts as stationary
constexpr std::size_t kLeastSamples = 27;
// The tip leaves the surface in a window if its force is below this part of the mean for longer than that.
constexpr double kLeastForcePart = 0.25;
constexpr double kLongestLoss_percent = 5.0;
// Frequencies above this part of the samples' rate are left to the probe's anti-aliasing.
constexpr double kHighestPartOfRate = 0.4;

struct Series {
  std::vector<double> t_s, a_normal_mps2, force_N;
  std::vector<Eigen::Vector3d> n_world;
};

Series project_forces(const TipMotion& samples, std::span<const std::int64_t> normal_t_ns,
                      std::span<const Eigen::Vector3d> n_world) {
  Series out;
  out.t_s.reserve(samples.size());
  out.a_normal_mps2.reserve(samples.size());
  out.n_world.reserve(samples.size());
  std::size_t k = 0;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    while (k + 1 < n_world.size() && normal_t_ns[k + 1] <= samples.t_ns[i]) ++k;
    out.n_world.push_back(n_world[k]);
    out.a_normal_mps2.push_back(samples.a_world_tip_mps2[i].dot(n_world[k]));
    out.t_s.push_back(static_cast<double>(samples.t_ns[i] - samples.t_ns.front()) * kNanosecond_s);
  }
  out.force_N = bridge_gaps(out.t_s, samples.force_N);
  return out;
}

Eigen::Vector3d median_point(std::span<const Eigen::Vector3d> p_m) {
  Eigen::Vector3d out;
  std::vector<double> values(p_m.size());
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    std::transform(p_m.begin(), p_m.end(), values.begin(), [=](const Eigen::Vector3d& p) { return p[axis]; });
    out[axis] = median(values);
  }
  return out;
}

class Cutter {
 public:
  Cutter(const TipMotion& samples, const Series& series) : samples_(samples), series_(series) {}

  std::size_t index_at(double t_s) const {
    return static_cast<std::size_t>(std::lower_bound(series_.t_s.begin(), series_.t_s.end(), t_s) -
                                    series_.t_s.begin());
  }

  // Along the surface, from the median positions of the first and the last third: the noise of a tracker falls
  // with the travel between them, and flipped poses do not count. 0 for too few samples.
  double speed_mps(double from_s, double to_s) const {
    const std::size_t begin = index_at(from_s), end = index_at(to_s);
    const std::size_t third = (end - begin) / 3;
    if (third < 1) return 0.0;
    const auto p_m = std::span(samples_.p_world_tip_m).subspan(begin, end - begin);
    const double duration_s = series_.t_s[end - 1] - series_.t_s[begin];
    const Eigen::Vector3d& n = series_.n_world[(begin + end) / 2];
    const Eigen::Vector3d travel_m = median_point(p_m.last(third)) - median_point(p_m.first(third));
    return (travel_m - travel_m.dot(n) * n).norm() / (2.0 / 3.0 * duration_s);
  }

  double usual_speed_mps() const {
    std::vector<double> speeds;
    for (double t_s = 0.0; t_s + kSpeedWindow_s <= series_.t_s.back(); t_s += 0.5 * kSpeedWindow_s)
      speeds.push_back(speed_mps(t_s, t_s + kSpeedWindow_s));
    return speeds.empty() ? 0.0 : percentile(speeds, kUsualSpeedPercentile);
  }

  // One-sided densities, (m/s²)²/Hz, of the window [begin, end) at the frequencies (first + k) step.
  std::vector<double> densities(std::size_t begin, std::size_t end, double first_Hz, double step_Hz,
                                std::size_t count) const {
    const auto& t_s = series_.t_s;
    const double duration_s =
        (t_s[end - 1] - t_s[begin]) * static_cast<double>(end - begin) / static_cast<double>(end - begin - 1);
    double weights = 0.0, sum = 0.0;
    std::vector<double> weight(end - begin);
    for (std::size_t i = begin; i < end; ++i) {
      const double u = (t_s[i] - t_s[begin]) / (t_s[end - 1] - t_s[begin]);
      weight[i - begin] = 0.5 * (1.0 - std::cos(2.0 * std::numbers::pi * u));
      weights += weight[i - begin];
      sum += weight[i - begin] * series_.a_normal_mps2[i];
    }
    const double mean_mps2 = sum / weights;
    std::vector<std::complex<double>> out(count);
    double squares = 0.0;
    for (std::size_t i = begin; i < end; ++i) {
      const double angle = -2.0 * std::numbers::pi * (t_s[i] - t_s[begin]);
      std::complex<double> phase = std::polar(1.0, angle * first_Hz);
      const std::complex<double> turn = std::polar(1.0, angle * step_Hz);
      const double x = weight[i - begin] * (series_.a_normal_mps2[i] - mean_mps2);
      squares += weight[i - begin] * weight[i - begin];
      for (std::complex<double>& sum_k : out) {
        sum_k += x * phase;
        phase *= turn;
      }
    }
    // Of a mean over the window: each sample stands for duration / count seconds.
    const double scale = 2.0 * duration_s / (static_cast<double>(end - begin) * squares);
    std::vector<double> density;
    density.reserve(count);
    for (const std::complex<double>& sum_k : out) density.push_back(scale * std::norm(sum_k));
    return density;
  }

  bool is_in_contact(std::size_t begin, std::size_t end, double mean_N) const {
    const auto force_N = std::span(series_.force_N).subspan(begin, end - begin);
    return percentile(force_N, kLongestLoss_percent) >= kLeastForcePart * mean_N;
  }

  double mean_force_N(std::size_t begin, std::size_t end) const {
    return mean(std::span(series_.force_N).subspan(begin, end - begin));
  }

 private:
  const TipMotion& samples_;
  const Series& series_;
};

}  // namespace

ComplianceWindows cut_compliance_windows(const TipMotion& samples, std::span<const std::int64_t> normal_t_ns,
                                         std::span<const Eigen::Vector3d> n_world, const ComplianceConfig& config) {
  ComplianceWindows out;
  if (samples.size() < kLeastSamples ||
      std::none_of(samples.force_N.begin(), samples.force_N.end(), [](double f) { return std::isfinite(f); }))
    return out;
  const Series series = project_forces(samples, normal_t_ns, n_world);
  const Cutter cutter(samples, series);
  const double usual_mps = cutter.usual_speed_mps();
  const double least_mps = std::max(config.min_speed_mps, kMovingPart * usual_mps);
  if (!(usual_mps >= config.min_speed_mps)) return out;

  const double length_m = 1e-3 * config.window_mm;
  const double duration_s = length_m / usual_mps;
  const double rate_Hz = static_cast<double>(samples.size() - 1) / series.t_s.back();
  // Frequencies, cycles/m, one resolution of the window apart.
  const double first = 1e3 * config.min_cycles_per_mm, step = 1.0 / length_m;
  const double last = std::min(1e3 * config.max_cycles_per_mm, kHighestPartOfRate * rate_Hz / usual_mps);
  if (last < first) return out;
  const auto count = static_cast<std::size_t>((last - first) / step + 1.0 + 1e-9);
  const auto band_power = [&](const std::vector<double>& density) {
    double sum = 0.0;
    for (std::size_t k = 0; k < count; ++k) sum += density[k] / (1e-3 * (first + static_cast<double>(k) * step));
    return sum;
  };

  struct Moving {
    std::size_t begin, end;
    double force_N, speed_mps;
  };
  std::vector<Moving> moving;
  double rest = 0.0, rests = 0.0;
  for (double from_s = 0.0; from_s + duration_s <= series.t_s.back(); from_s += 0.5 * duration_s) {
    const double to_s = from_s + duration_s, middle_s = 0.5 * (from_s + to_s);
    const std::size_t begin = cutter.index_at(from_s), end = cutter.index_at(to_s);
    if (end - begin < kLeastSamples) continue;
    const double half_s = 0.5 * std::max(duration_s, kSpeedWindow_s);
    const double speed = cutter.speed_mps(std::max(0.0, middle_s - half_s), middle_s + half_s);
    if (speed < kStationaryPart * usual_mps) {
      rest += band_power(cutter.densities(begin, end, first * usual_mps, step * usual_mps, count));
      rests += 1.0;
      continue;
    }
    // A stroke may begin or end inside.
    const double slowest = std::min({speed, cutter.speed_mps(middle_s - half_s, middle_s - half_s / 3.0),
                                     cutter.speed_mps(middle_s + half_s / 3.0, middle_s + half_s)});
    if (slowest < least_mps) continue;
    const double force_N = cutter.mean_force_N(begin, end);
    if (!(force_N >= config.min_force_N)) continue;
    ++out.moving;
    if (!cutter.is_in_contact(begin, end, force_N)) {
      ++out.lost;
      continue;
    }
    moving.push_back({begin, end, force_N, speed});
  }
  if (rests > 0.0) rest /= rests;
  out.rest_amplitude_mps2 = std::sqrt(rest * step * usual_mps);
  for (const Moving& w : moving) {
    // a = v² h″; a density a hertz becomes one a cycle/m by another v.
    const double scale = 1.0 / (w.speed_mps * w.speed_mps * w.speed_mps);
    const auto density = cutter.densities(w.begin, w.end, first * w.speed_mps, step * w.speed_mps, count);
    out.force_N.push_back(w.force_N);
    out.speed_mps.push_back(w.speed_mps);
    out.power.push_back(scale * band_power(density));
    out.noise.push_back(scale * rest);
  }
  return out;
}

}  // namespace asperity
