#include "asperity/registration/pose_misfit.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "find_unobservable_dofs.h"
#include "match_points.h"
#include "point_set.h"

namespace asperity {

namespace {

using registration::Match;
using registration::PointSet;

constexpr double kOutlier = 4.0;
constexpr std::size_t kLeastCounted = 10;

// Mean over `length_m` of path about each point, of the points that count.
std::vector<double> slow_part(const PointSet& points, const std::vector<double>& d_m, const std::vector<char>& counts,
                              double length_m) {
  std::vector<double> out(d_m.size(), 0.0);
  std::size_t first = 0, last = 0;
  for (std::size_t i = 0; i < d_m.size(); ++i) {
    while (points.path[first] != points.path[i] || points.s_m[i] - points.s_m[first] > 0.5 * length_m) ++first;
    last = std::max(last, i);
    while (last + 1 < d_m.size() && points.path[last + 1] == points.path[i] &&
           points.s_m[last + 1] - points.s_m[i] <= 0.5 * length_m) {
      ++last;
    }
    double sum_m = 0.0, count = 0.0;
    for (std::size_t k = first; k <= last; ++k) {
      if (counts[k] == 0) continue;
      sum_m += d_m[k];
      count += 1.0;
    }
    if (count > 0.0) out[i] = sum_m / count;
  }
  return out;
}

// Mean variance of the paths' slow errors along the normals under their points.
double slow_variance_m2(std::span<const MeasuredPath> paths, const PointSet& points, const std::vector<Match>& matches,
                        const std::vector<char>& counts, const Eigen::Quaterniond& rotation) {
  double sum_m2 = 0.0, count = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (counts[i] == 0) continue;
    const Eigen::Vector3d n_world = rotation.conjugate() * matches[i].n;
    sum_m2 += n_world.dot(paths[points.path[i]].slow_covariance_world_m2 * n_world);
    count += 1.0;
  }
  return count > 0.0 ? sum_m2 / count : 0.0;
}

// Points whose mean distance over `length_m` of path is beyond what an error of path or mesh can be. Single points are
// not asked: a relief can be as deep. The scale is that of the nearest quarter, so that most of a path may be off.
void measure_off(const PointSet& points, const std::vector<double>& d_m, const std::vector<char>& over, double length_m,
                 PoseMisfit& out) {
  constexpr double kQuarter = 0.3186;  // 25th percentile of |x| for normal x
  constexpr double kScales = 6.0, kOfExtent = 0.03;
  const std::vector<double> slow_m = slow_part(points, d_m, over, length_m);
  std::vector<double> mean_m;
  for (std::size_t i = 0; i < d_m.size(); ++i) {
    if (over[i] != 0) mean_m.push_back(std::abs(slow_m[i]));
  }
  if (mean_m.size() < kLeastCounted) return;
  std::sort(mean_m.begin(), mean_m.end());
  out.off_limit_m = std::max(kScales * mean_m[mean_m.size() / 4] / kQuarter, kOfExtent * points.radius_m);
  const auto first = std::upper_bound(mean_m.begin(), mean_m.end(), out.off_limit_m);
  const auto off = static_cast<std::size_t>(mean_m.end() - first);
  out.off_share = static_cast<double>(off) / static_cast<double>(mean_m.size());
  if (off > 0) out.off_m = first[static_cast<std::ptrdiff_t>(off / 2)];
}

}  // namespace

PoseMisfit measure_pose_misfit(std::span<const MeasuredPath> paths, const RegistrationSurface& surface,
                               const std::optional<Pose>& guess, const PoseMisfitConfig& config,
                               const RegistrationResult& result) {
  PoseMisfit out;
  Problems ignored;
  const PointSet points = registration::gather_points(paths, ignored);
  const registration::CentredPose pose = registration::centred(result.T_mesh_world, points);
  std::vector<std::uint32_t> all(points.size());
  std::iota(all.begin(), all.end(), 0U);
  registration::Matcher matcher(surface, points, all, {});
  matcher.match(pose);
  const std::vector<Match>& matches = matcher.matches();
  const double limit_m = kOutlier * matcher.scale_m();
  std::vector<double> d_m(points.size());
  std::vector<char> counts(points.size(), 0), over(points.size(), 0);
  std::size_t count = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    d_m[i] = matches[i].distance_m;
    over[i] = matches[i].usable ? 1 : 0;
    counts[i] = matches[i].usable && std::abs(d_m[i]) <= limit_m ? 1 : 0;
    count += counts[i] != 0 ? 1 : 0;
  }
  measure_off(points, d_m, over, config.slow_length_m, out);
  if (guess) {
    const registration::CentredPose from = registration::centred(*guess, points);
    out.guess_shift_m = (pose.centre_m - from.centre_m).norm();
    out.guess_rotation_rad = pose.rotation.angularDistance(from.rotation);
    out.guess_sigma_m = config.guess_sigma_m;
    out.guess_sigma_rad = config.guess_sigma_rad;
    out.guess_stated = config.guess_stated;
  }
  if (count < kLeastCounted) return out;
  const std::vector<double> slow_m = slow_part(points, d_m, counts, config.slow_length_m);
  double slow_m2 = 0.0, relief_m2 = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (counts[i] == 0) continue;
    slow_m2 += slow_m[i] * slow_m[i];
    relief_m2 += (d_m[i] - slow_m[i]) * (d_m[i] - slow_m[i]);
  }
  const auto n = static_cast<double>(count);
  out.slow_m = std::sqrt(slow_m2 / n);
  out.relief_m = std::sqrt(relief_m2 / n);
  const double variance_m2 = slow_variance_m2(paths, points, matches, counts, pose.rotation);
  const double sag_m = registration::facet_sag_m(surface, matcher);
  out.explained_m =
      std::sqrt(variance_m2 + sag_m * sag_m + config.surface_error_m * config.surface_error_m + relief_m2 / n);
  out.extent_m = points.radius_m;
  return out;
}

}  // namespace asperity
