#include "fit_curved_surface.h"

#include <algorithm>
#include <cmath>

#include "asperity/algebra/solve.h"
#include "robust_plane.h"

namespace asperity {

namespace {

using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

constexpr int kRounds = 30;
constexpr double kSettled = 1e-9;
constexpr double kSteepest = 0.95;  // uᵀK²u: beyond, the surface turns back
constexpr double kSpent = 6.0;      // errors that the fit uses up
// By Akaike one for each parameter more; that bodies of revolution are more usual counts e^4.5.
constexpr double kMoreThanPlane = 3.0, kMoreThanCircle = 6.0;
constexpr double kLeast = 0.1;  // of the slow error: coarse points have no smaller one

struct Height {
  double z_m;
  Eigen::Vector2d slope;
};

// z and its gradient. With s = √(1 − m): z = q/(1 + s), ∇z = 2 K u/(1 + s) + q K²u/(s (1 + s)²).
Height height_of(const Eigen::Matrix2d& K, const Eigen::Vector2d& u) {
  const Eigen::Vector2d Ku = K * u;
  const double s = std::sqrt(1.0 - std::min(Ku.squaredNorm(), kSteepest));
  const double q = u.dot(Ku);
  return {q / (1.0 + s), 2.0 / (1.0 + s) * Ku + q / (s * (1.0 + s) * (1.0 + s)) * (K * Ku)};
}

}  // namespace

CurvedSurface::Foot CurvedSurface::foot(const Eigen::Vector3d& p_m) const {
  constexpr int kSteps = 4;
  const Eigen::Vector3d d = axes.transpose() * (p_m - point_m);
  Eigen::Vector3d at = d, normal = Eigen::Vector3d::UnitZ();
  for (int step = 0; step < kSteps; ++step) {
    const Height height = height_of(curvature_per_m, at.head<2>());
    normal = Eigen::Vector3d(-height.slope.x(), -height.slope.y(), 1.0).normalized();
    at = d - normal.dot(d - Eigen::Vector3d(at.x(), at.y(), height.z_m)) * normal;
  }
  return {point_m + axes * at, axes * normal};
}

bool covers_area(const PathEvidence& evidence, const BasePathConfig& config) {
  constexpr double kWide = 3.0;  // slow errors
  constexpr double kRows = 1.5;  // times the path's own extent: it comes back
  std::vector<double> weights;
  const PlaneFit fit = fit_robust_plane(evidence.coarse_m, config.slow_error_m, weights);
  // Wide across the probe: strokes over one line that sink deeper cover no area.
  const Eigen::Vector3d axis = mean_axis(evidence);
  if (std::abs(fit.axes.col(1).dot(axis)) > std::cos(kLargestLean_rad) * axis.norm()) return false;
  const double extent_m = std::sqrt(12.0 * fit.scatter_m2.x());  // of points that are spread evenly
  return evidence.travelled_m.back() > kRows * extent_m && std::sqrt(fit.scatter_m2.y()) > kWide * config.slow_error_m;
}

CurvedSurface fit_curved_surface(const PlaneCandidate& plane, const PathEvidence& evidence,
                                 const BasePathConfig& config) {
  CurvedSurface out;
  Eigen::Vector3d mean_m = Eigen::Vector3d::Zero();
  const double travelled_m = evidence.travelled_m.back();
  for (std::size_t c = 0; c < evidence.path.size(); ++c)
    mean_m += evidence.weight[c] / travelled_m * evidence.path.p_m[c];
  out.point_m = mean_m;
  out.axes.col(0) = plane.stroke;
  out.axes.col(1) = plane.normal.cross(plane.stroke);
  out.axes.col(2) = plane.normal;
  // The curvatures in units of a reach, so that the equations are well scaled.
  double reach_m = 0.0;
  for (std::size_t c = 0; c < evidence.path.size(); ++c)
    reach_m += evidence.weight[c] / travelled_m * (evidence.path.p_m[c] - mean_m).squaredNorm();
  reach_m = std::sqrt(reach_m);
  for (int round = 0; round < kRounds; ++round) {
    Matrix6 information = Matrix6::Zero();
    Vector6 gradient = Vector6::Zero();
    for (std::size_t c = 0; c < evidence.path.size(); ++c) {
      const double w = evidence.weight[c] / travelled_m;
      if (w == 0.0) continue;
      const Eigen::Vector3d d = out.axes.transpose() * (evidence.path.p_m[c] - out.point_m);
      const Eigen::Vector2d u = d.head<2>() / reach_m;
      const double left_m = d.z() - height_of(out.curvature_per_m, d.head<2>()).z_m;
      Vector6 j;  // to the first order of the curvatures
      j << 1.0, u.x(), u.y(), 0.5 * u.x() * u.x(), u.x() * u.y(), 0.5 * u.y() * u.y();
      information += w * j * j.transpose();
      gradient += w * left_m * j;
    }
    // A path that shows not all of it keeps what it does not show.
    information.diagonal().array() += 1e-9;
    const Vector6 step = solve_symmetric(information, gradient);
    if (!step.allFinite()) break;
    out.point_m += step(0) * out.axes.col(2);
    Eigen::Matrix2d change;
    change << step(3), step(4), step(4), step(5);
    out.curvature_per_m += change / (reach_m * reach_m);
    const Eigen::Vector3d normal =
        (out.axes.col(2) - step(1) / reach_m * out.axes.col(0) - step(2) / reach_m * out.axes.col(1)).normalized();
    const Eigen::Matrix3d turn =
        Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d(out.axes.col(2)), normal).toRotationMatrix();
    out.axes = turn * out.axes;
    if (step.norm() < kSettled * reach_m) break;
  }
  out.rms_m = std::sqrt(square_of_means(evidence, [&](std::size_t c) {
    const Eigen::Vector3d d = out.axes.transpose() * (evidence.path.p_m[c] - out.point_m);
    return d.z() - height_of(out.curvature_per_m, d.head<2>()).z_m;
  }));
  std::vector<double> weights;
  const PlaneFit spread = fit_robust_plane(evidence.coarse_m, config.slow_error_m, weights);
  out.normal_sigma_rad = std::max(config.slow_error_m, out.rms_m) /
                         std::sqrt(std::max(1.0, evidence.independent - kSpent) * spread.scatter_m2.y());
  return out;
}

double curved_log_odds(const CurvedSurface& surface, double rival_rms_m, bool rival_is_round,
                       const PathEvidence& evidence, const BasePathConfig& config) {
  const double least_m = kLeast * config.slow_error_m;
  const double ratio = std::hypot(rival_rms_m, least_m) / std::hypot(surface.rms_m, least_m);
  return evidence.independent * std::log(ratio) - (rival_is_round ? kMoreThanCircle : kMoreThanPlane);
}

}  // namespace asperity
