#include "motion_times.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "asperity/base/error.h"
#include "asperity/base/units.h"
#include "asperity/signal/statistics.h"

namespace asperity {

namespace {

// The median standard deviation of the position, less what is one error all along; 0 without a covariance.
double usual_sigma_m(const TipMotion& motion) {
  if (motion.cov_world_tip_m2.empty()) return 0.0;
  std::vector<double> sigma_m;
  sigma_m.reserve(motion.size());
  for (const Eigen::Matrix3d& cov : motion.cov_world_tip_m2)
    sigma_m.push_back(std::sqrt(std::max(0.0, (cov.trace() - motion.sigma_tip_in_marker_m.squaredNorm()) / 3.0)));
  return median(sigma_m);
}

// How much a low-pass may cut a bend before it is followed. Over a plane or circle five standard deviations: noise does
// not bend the path by more. A mesh brings its own bends, and a smoothed path's error is slow: half of one.
double bend_m(double sigma_m, PathShape shape) {
  if (sigma_m == 0.0) return 0.0;
  return shape == PathShape::kMesh ? std::clamp(0.5 * sigma_m, 0.02e-3, 0.3e-3)
                                   : std::clamp(5.0 * sigma_m, 0.1e-3, 1e-3);
}

}  // namespace

std::vector<double> motion_times_s(const TipMotion& motion) {
  const std::size_t n = motion.size();
  if (n < 20) throw Error("base path: " + std::to_string(n) + " samples, at least 20 are needed");
  if (motion.p_world_tip_m.size() != n || motion.q_world_marker.size() != n ||
      (!motion.force_N.empty() && motion.force_N.size() != n)) {
    throw Error("base path: the motion's vectors differ in size");
  }
  std::vector<double> t_s(n);
  for (std::size_t i = 0; i < n; ++i) {
    t_s[i] = static_cast<double>(motion.t_ns[i] - motion.t_ns[0]) * kNanosecond_s;
    if (i > 0 && motion.t_ns[i] <= motion.t_ns[i - 1])
      throw Error("base path: time does not rise at sample " + std::to_string(i));
    if (!motion.p_world_tip_m[i].allFinite() || !motion.q_world_marker[i].coeffs().allFinite()) {
      throw Error("base path: sample " + std::to_string(i) + " is not finite");
    }
  }
  return t_s;
}

void follow_path(const TipMotion& motion, const std::vector<double>& t_s, const std::vector<Eigen::Vector2d>& developed,
                 const BasePathConfig& config, BasePathResult& out) {
  ArcLengthConfig arc_length = config.arc_length;
  const double sigma_m = usual_sigma_m(motion);
  if (arc_length.bend_m == 0.0) arc_length.bend_m = bend_m(sigma_m, out.shape);
  if (arc_length.noise_m == 0.0) arc_length.noise_m = sigma_m;
  ArcLength arc = measure_arc_length(t_s, developed, out.contact, arc_length);
  out.path.s_m = std::move(arc.s_m);
  out.speed_mps = std::move(arc.speed_mps);
  out.turning_points = std::move(arc.turning_points);
  out.bends_m = arc.bends_m;
  out.length_m = *std::max_element(out.path.s_m.begin(), out.path.s_m.end());
}

}  // namespace asperity
