#include "fit_pose_fully.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace asperity::registration {
namespace {

double robust_cost(double d_m, double width_m) {
  return std::isnan(d_m) ? 1.0 : -std::expm1(-d_m * d_m / (width_m * width_m));
}

void evaluate_pose(ConvergedPose& out, Matcher& matcher, const RegistrationConfig& config) {
  if (!out.fit.matched) matcher.match(out.pose);
  const double limit_m = config.outlier_sigmas * matcher.scale_m();
  double square = 0.0;
  double sum = 0.0;
  std::size_t inliers = 0;
  std::size_t found = 0;
  out.distances_m.assign(matcher.size(), std::numeric_limits<double>::quiet_NaN());
  for (std::size_t i = 0; i < matcher.size(); ++i) {
    const Match& m = matcher.matches()[i];
    if (matcher.closest()[i].found()) {
      sum += std::abs(m.distance_m);
      ++found;
    }
    if (!m.usable) continue;
    out.distances_m[i] = m.distance_m;
    if (std::abs(m.distance_m) > limit_m) continue;
    square += m.distance_m * m.distance_m;
    ++inliers;
  }
  out.outliers = matcher.size() - inliers;
  out.mean_m = found == 0 ? 0.0 : sum / static_cast<double>(found);
  out.rms_m = inliers == 0 ? 0.0 : std::sqrt(square / static_cast<double>(inliers));
  out.sigma_m = inliers > 6 ? std::sqrt(square / static_cast<double>(inliers - 6)) : out.rms_m;
}

}  // namespace

ConvergedPose fit_pose_fully(const RegistrationSurface& surface, const PointSet& points, const MatchRules& rules,
                             Matcher& matcher, const CentredPose& start, FitOptions options,
                             const RegistrationConfig& config) {
  constexpr int kRounds = 3;
  ConvergedPose out;
  out.fit = fit_pose(matcher, points, start, options);
  out.pose = out.fit.pose;
  int iterations = out.fit.iterations;
  for (int round = 0; round < kRounds; ++round) {
    evaluate_pose(out, matcher, config);
    out.observability = find_unobservable_dofs(surface, points, rules, matcher, out.pose, out.sigma_m, config);
    if (out.observability.held.empty() || !out.fit.enough) break;
    const Vector6 from_guess = motion_between(options.reference, out.pose);
    CentredPose back = out.pose;
    double strayed_m = 0.0;
    options.holds.clear();
    for (const Vector6& v : out.observability.held) {
      const Vector6 row = out.observability.metric * v;
      const double along_m = row.dot(from_guess);
      back = moved(back, -along_m * v);
      strayed_m = std::hypot(strayed_m, along_m);
      options.holds.push_back({row, 0.0});
    }
    if (round + 1 == kRounds || strayed_m < 0.01 * config.undetermined_m) break;
    out.fit = fit_pose(matcher, points, back, options);
    out.pose = out.fit.pose;
    iterations += out.fit.iterations;
  }
  out.fit.iterations = iterations;
  return out;
}

double path_noise_m(const PointSet& points, const Matcher& matcher, const CentredPose& pose) {
  if (points.sigma_m > 0.0) return points.sigma_m;
  std::vector<double> differences;
  differences.reserve(matcher.size());
  for (std::size_t k = 0; k < matcher.size(); ++k) {
    const std::uint32_t i = matcher.chosen(k);
    if (i == 0 || i + 1 >= points.size() || !matcher.matches()[k].usable) continue;
    if (points.path[i - 1] != points.path[i] || points.path[i + 1] != points.path[i]) continue;
    const Eigen::Vector3d second_m = points.x_m[i - 1] - 2.0 * points.x_m[i] + points.x_m[i + 1];
    differences.push_back(std::abs(matcher.matches()[k].n.dot(pose.rotation * second_m)));
  }
  if (differences.empty()) return 0.0;
  const auto middle = differences.begin() + static_cast<std::ptrdiff_t>(differences.size() / 2);
  std::nth_element(differences.begin(), middle, differences.end());
  return *middle / (0.6745 * std::sqrt(6.0));
}

double robust_mean(const std::vector<double>& distances_m, double width_m) {
  double sum = 0.0;
  for (const double d_m : distances_m) sum += robust_cost(d_m, width_m);
  return sum / static_cast<double>(distances_m.size());
}

double excess_z(const std::vector<double>& a_m, const std::vector<double>& b_m, double width_m) {
  constexpr std::size_t kStretches = 20;
  const std::size_t stretches = std::min(kStretches, a_m.size());
  std::array<double, kStretches> excess{};
  double mean = 0.0;
  for (std::size_t s = 0; s < stretches; ++s) {
    const std::size_t begin = s * a_m.size() / stretches;
    const std::size_t end = (s + 1) * a_m.size() / stretches;
    for (std::size_t i = begin; i < end; ++i) excess[s] += robust_cost(b_m[i], width_m) - robust_cost(a_m[i], width_m);
    excess[s] /= static_cast<double>(end - begin);
    mean += excess[s] / static_cast<double>(stretches);
  }
  double square = 0.0;
  for (std::size_t s = 0; s < stretches; ++s) square += (excess[s] - mean) * (excess[s] - mean);
  const double error = std::sqrt(square / static_cast<double>(stretches * std::max<std::size_t>(stretches - 1, 1)));
  return error > 0.0 ? mean / error : (mean > 0.0 ? std::numeric_limits<double>::infinity() : 0.0);
}

}  // namespace asperity::registration
