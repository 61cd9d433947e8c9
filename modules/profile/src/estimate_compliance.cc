#include "asperity/profile/estimate_compliance.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "asperity/base/error.h"
#include "asperity/base/units.h"
#include "asperity/signal/resample.h"
#include "asperity/signal/statistics.h"

namespace asperity {
namespace {

constexpr double kUsualSpeedPercentile = 80.0;
constexpr double kMovingPart = 0.5;      // of the usual speed: faster counts as a stroke
constexpr double kStationaryPart = 0.2;  // slower counts as stationary
// Percentiles 10 and 90 of a normal distribution are this many standard deviations apart.
constexpr double kSigmasBetweenDeciles = 2.5631031310892007;
// What is left of an amplitude that does not stand out from the one at rest, in squares.
constexpr double kLeastSquarePart = 0.05;

struct Series {
  std::vector<double> a_normal_mps2;
  std::vector<Eigen::Vector3d> n_world;
  std::vector<double> force_N;
};

Series project(const TipMotion& samples, std::span<const std::int64_t> normal_t_ns,
               std::span<const Eigen::Vector3d> n_world) {
  Series out;
  std::vector<double> t_s;
  std::size_t k = 0;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    while (k + 1 < n_world.size() && normal_t_ns[k + 1] <= samples.t_ns[i]) ++k;
    out.n_world.push_back(n_world[k]);
    out.a_normal_mps2.push_back(samples.a_world_tip_mps2[i].dot(n_world[k]));
    t_s.push_back(static_cast<double>(samples.t_ns[i] - samples.t_ns.front()) * kNanosecond_s);
  }
  out.force_N = bridge_gaps(t_s, samples.force_N);
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

// Along the surface, from the median positions of the first and the last third: the noise of a tracker falls
// with the travel between them, and flipped poses do not count.
double speed_mps(std::span<const Eigen::Vector3d> p_m, const Eigen::Vector3d& n_world, double duration_s) {
  const std::size_t third = p_m.size() / 3;
  const Eigen::Vector3d travel_m = median_point(p_m.last(third)) - median_point(p_m.first(third));
  return (travel_m - travel_m.dot(n_world) * n_world).norm() / (2.0 / 3.0 * duration_s);
}

struct Candidate {
  ComplianceWindow window;
  double slowest_end_mps = 0.0;  // speed in the first or last third: a stroke may begin or end inside
};

// All windows; their ratios not yet known.
std::vector<Candidate> cut(const TipMotion& samples, const Series& series, std::int64_t window_ns) {
  constexpr std::size_t kLeastSamples = 27;  // nine a third
  std::vector<Candidate> windows;
  if (samples.size() == 0) return windows;
  const auto& t_ns = samples.t_ns;
  for (std::int64_t start = t_ns.front(); start + window_ns <= t_ns.back(); start += window_ns / 2) {
    const auto begin = static_cast<std::size_t>(std::lower_bound(t_ns.begin(), t_ns.end(), start) - t_ns.begin());
    const auto end =
        static_cast<std::size_t>(std::lower_bound(t_ns.begin(), t_ns.end(), start + window_ns) - t_ns.begin());
    if (end - begin < kLeastSamples) continue;
    const auto part = [&](const std::vector<double>& x) { return std::span(x).subspan(begin, end - begin); };
    const auto a = part(series.a_normal_mps2);
    ComplianceWindow window;
    window.force_N = mean(part(series.force_N));
    window.amplitude_mps2 = (percentile(a, 90.0) - percentile(a, 10.0)) / kSigmasBetweenDeciles;
    const auto p_m = std::span(samples.p_world_tip_m).subspan(begin, end - begin);
    const Eigen::Vector3d& n_world = series.n_world[(begin + end) / 2];
    const double duration_s = static_cast<double>(window_ns) * kNanosecond_s;
    window.speed_mps = speed_mps(p_m, n_world, duration_s);
    const std::size_t third = p_m.size() / 3;
    windows.push_back({window, std::min(speed_mps(p_m.first(third), n_world, duration_s / 3.0),
                                        speed_mps(p_m.last(third), n_world, duration_s / 3.0))});
  }
  return windows;
}

double rest_amplitude_mps2(const std::vector<Candidate>& windows, double usual_mps) {
  std::optional<double> least;
  for (const auto& [window, end_mps] : windows) {
    if (window.speed_mps < kStationaryPart * usual_mps) {
      least = std::min(least.value_or(window.amplitude_mps2), window.amplitude_mps2);
    }
  }
  return least.value_or(0.0);
}

}  // namespace

double compliance_coefficient(double sigma_r2) { return std::exp(-sigma_r2); }

Compliance estimate_compliance(const TipMotion& samples, std::span<const std::int64_t> normal_t_ns,
                               std::span<const Eigen::Vector3d> n_world, const ComplianceConfig& config) {
  const std::size_t n = samples.size();
  if (samples.a_world_tip_mps2.size() != n || samples.p_world_tip_m.size() != n || samples.force_N.size() != n ||
      normal_t_ns.size() != n_world.size() || n_world.empty()) {
    throw Error("compliance: " + std::to_string(n) + " samples, " + std::to_string(samples.a_world_tip_mps2.size()) +
                " accelerations, " + std::to_string(samples.force_N.size()) + " forces, " +
                std::to_string(n_world.size()) + " normals");
  }
  const Series series = project(samples, normal_t_ns, n_world);
  const auto window_ns = static_cast<std::int64_t>(std::llround(config.window_s / kNanosecond_s));
  const std::vector<Candidate> all = cut(samples, series, window_ns);
  Compliance out;
  if (all.empty()) return out;

  std::vector<double> speeds_mps;
  speeds_mps.reserve(all.size());
  for (const Candidate& candidate : all) speeds_mps.push_back(candidate.window.speed_mps);
  const double usual_mps = percentile(speeds_mps, kUsualSpeedPercentile);
  out.rest_amplitude_mps2 = rest_amplitude_mps2(all, usual_mps);
  const double least_speed_mps = std::max(config.min_speed_mps, kMovingPart * usual_mps);
  for (auto [window, slowest_end_mps] : all) {
    const double square = window.amplitude_mps2 * window.amplitude_mps2;
    window.amplitude_mps2 =
        std::sqrt(std::max(square - out.rest_amplitude_mps2 * out.rest_amplitude_mps2, kLeastSquarePart * square));
    const bool counts = window.force_N >= config.min_force_N && window.speed_mps >= least_speed_mps &&
                        slowest_end_mps >= least_speed_mps;
    if (counts && window.amplitude_mps2 > 0.0) out.windows.push_back(window);
  }
  if (out.windows.size() < static_cast<std::size_t>(config.min_windows)) return out;

  std::vector<double> ratio, log_ratio, log_force;
  for (const ComplianceWindow& window : out.windows) {
    ratio.push_back(window.force_N * window.speed_mps * window.speed_mps / window.amplitude_mps2);
  }
  const double scale = 1.0 / mean(ratio);
  for (std::size_t i = 0; i < ratio.size(); ++i) {
    out.windows[i].ratio = ratio[i] *= scale;
    log_ratio.push_back(std::log(ratio[i]));
    log_force.push_back(std::log(out.windows[i].force_N));
  }
  out.ratio_variance = variance(ratio);
  const auto [light, firm] = std::minmax_element(log_force.begin(), log_force.end());
  if (*firm - *light < std::log(config.min_force_ratio)) return out;

  const LinearFit fit = linear_regression(log_force, log_ratio);
  out.exponent = fit.slope;
  out.exponent_error = fit.slope_error;
  std::vector<double> fitted;
  fitted.reserve(log_force.size());
  for (const double f : log_force) fitted.push_back(std::exp(fit.slope * (f - log_force.front())));
  const double fitted_mean = mean(fitted);
  out.sigma_r2 = variance(fitted) / (fitted_mean * fitted_mean);
  out.k_c = compliance_coefficient(out.sigma_r2);
  return out;
}

}  // namespace asperity
