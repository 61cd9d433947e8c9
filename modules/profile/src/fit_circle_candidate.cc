#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "asperity/algebra/solve.h"
#include "fit_base_shape.h"
#include "fit_curved_surface.h"
#include "robust_plane.h"

namespace asperity {

namespace {

constexpr double kAxisTilt_rad =
    30.0 * kDegreeOfFit_rad;  // of the cylinder's axis from the principal axis it starts at, a weak prior

// A stroke with the forearm about the elbow is an arc of 0.33 m: what a hand's stroke bends sideways on the body.
constexpr double kSideways_per_m = 3.0;

// vᵀMv: how badly a unit axis v agrees with the probe's axis, which lies along the normals and so across it, and with
// the path's curvature 1/R. That is the normal's but for the geodesic curvature, so v is across the radii within
// kSideways_per_m R.
Eigen::Matrix3d across_information(const CircleCandidate& circle, const PathEvidence& evidence,
                                   const BasePathConfig& config) {
  const double axis_sigma = config.probe_axis_sigma_deg * kDegreeOfFit_rad,
               curvature_sigma = kSideways_per_m * circle.radius_m;
  const double count = static_cast<double>(evidence.coarse_m.size());
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
  for (std::size_t i = 0; i < evidence.coarse_m.size(); ++i) {
    const Eigen::Vector3d& axis = evidence.coarse_axis[i];
    information += axis * axis.transpose() / (count * axis_sigma * axis_sigma);
    const Eigen::Vector3d d = evidence.coarse_m[i] - circle.centre_m;
    const Eigen::Vector3d radial = (d - d.dot(circle.axis) * circle.axis).normalized();
    information += radial * radial.transpose() / (count * curvature_sigma * curvature_sigma);
  }
  return information;
}

// How well the lean of the normals is known, by the covariance of the axis' slopes towards e1 and e2.
void find_lean_sigma(CircleCandidate& circle, const PathEvidence& evidence, const Eigen::Matrix2d& covariance,
                     const Eigen::Vector3d& e1, const Eigen::Vector3d& e2) {
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  double square = 0.0;
  const double count = static_cast<double>(evidence.coarse_m.size());
  for (const Eigen::Vector3d& p : evidence.coarse_m) {
    const Eigen::Vector3d d = p - circle.centre_m;
    const Eigen::Vector3d radial = (d - d.dot(circle.axis) * circle.axis).normalized();
    const Eigen::Vector2d slope(radial.dot(e1), radial.dot(e2));
    mean += slope / count;
    square += slope.dot(covariance * slope) / count;
  }
  const double of_mean = std::max(mean.dot(covariance * mean), 0.0);
  circle.lean_sigma_rad = std::sqrt(of_mean);
  circle.lean_change_rad = std::sqrt(std::max(square - of_mean, 0.0));
}

// Turns the axis of a circle's cylinder, and fits centre and radius with it, so that a path that also moves
// along the axis lies on the cylinder. Gauss-Newton with a step control on the cells of the path.
void refine_cylinder(CircleCandidate& circle, const PathEvidence& evidence, const BasePathConfig& config) {
  const double error_m = config.slow_error_m;
  const Eigen::Matrix3d across = across_information(circle, evidence, config);
  using Vector5 = Eigen::Matrix<double, 5, 1>;
  using Matrix5 = Eigen::Matrix<double, 5, 5>;
  const Eigen::Vector3d e1 = circle.axis.unitOrthogonal(), e2 = circle.axis.cross(e1);
  const double scale_m = circle.radius_m;
  const double unit = evidence.independent / (evidence.travelled_m.back() * error_m * error_m);
  // Parameters: slopes of the axis towards e1 and e2, the centre's moves along them and the radius's over the scale.
  const auto linearise = [&](const Vector5& x, Matrix5* information, Vector5* gradient) {
    const Eigen::Vector3d along = circle.axis + x(0) * e1 + x(1) * e2;
    const Eigen::Vector3d axis = along.normalized();
    const Eigen::Vector3d centre = circle.centre_m + scale_m * (x(2) * e1 + x(3) * e2);
    const double radius = scale_m * (1.0 + x(4));
    double cost = (x(0) * x(0) + x(1) * x(1)) / (kAxisTilt_rad * kAxisTilt_rad);
    if (information != nullptr) {
      information->setZero();
      gradient->setZero();
      (*information)(0, 0) = (*information)(1, 1) = 1.0 / (kAxisTilt_rad * kAxisTilt_rad);
      (*gradient)(0) = x(0) / (kAxisTilt_rad * kAxisTilt_rad);
      (*gradient)(1) = x(1) / (kAxisTilt_rad * kAxisTilt_rad);
      Eigen::Matrix<double, 3, 2> derivative;
      derivative << e1 - e1.dot(axis) * axis, e2 - e2.dot(axis) * axis;
      derivative /= along.norm();
      information->topLeftCorner<2, 2>() += derivative.transpose() * across * derivative;
      gradient->head<2>() += derivative.transpose() * across * axis;
    }
    cost += axis.dot(across * axis);
    for (std::size_t c = 0; c < evidence.path.size(); ++c) {
      const double w = unit * evidence.weight[c];
      if (w == 0.0) continue;
      const Eigen::Vector3d d = evidence.path.p_m[c] - centre;
      const double height = d.dot(axis);
      const Eigen::Vector3d radial = (d - height * axis).normalized();
      const double r = d.dot(radial) - radius;
      cost += w * r * r;
      if (information == nullptr) continue;
      Vector5 j;
      j << -height * radial.dot(e1) / along.norm(), -height * radial.dot(e2) / along.norm(), -scale_m * radial.dot(e1),
          -scale_m * radial.dot(e2), -scale_m;
      *information += w * j * j.transpose();
      *gradient += w * r * j;
    }
    return cost;
  };
  Vector5 x = Vector5::Zero();
  double damping = 1e-6;
  for (int iteration = 0; iteration < 60; ++iteration) {
    Matrix5 information;
    Vector5 gradient;
    const double cost = linearise(x, &information, &gradient);
    bool improved = false;
    for (int attempt = 0; attempt < 10 && !improved; ++attempt) {
      Matrix5 damped = information;
      damped.diagonal() *= 1.0 + damping;
      const Vector5 step = -solve_symmetric(damped, gradient);
      if (step.allFinite() && x(4) + step(4) > -0.9 && linearise(x + step, nullptr, nullptr) <= cost) {
        x += step;
        improved = true;
        damping *= 0.1;
        if (step.norm() < 1e-9) iteration = 60;
      } else {
        damping *= 10.0;
      }
    }
    if (!improved) break;
  }
  Matrix5 information;
  Vector5 gradient;
  linearise(x, &information, &gradient);
  circle.centre_m += scale_m * (x(2) * e1 + x(3) * e2);
  circle.axis = (circle.axis + x(0) * e1 + x(1) * e2).normalized();
  circle.radius_m = scale_m * (1.0 + x(4));
  const Eigen::MatrixXd covariance = inverse_of(information);
  find_lean_sigma(circle, evidence, covariance.topLeftCorner<2, 2>(), e1, e2);
}

}  // namespace

namespace {

// The circle about the path's principal axis `about`: seen along it, the cylinder's path is a circle.
CircleCandidate fit_circle_about(const PlaneFit& plane, int about, const PathEvidence& evidence,
                                 const BasePathConfig& config) {
  const Eigen::Vector3d e1 = plane.axes.col(about == 0 ? 1 : 0), e2 = plane.axes.col(about == 2 ? 1 : 2);
  std::vector<Eigen::Vector2d> points;
  std::vector<double> point_weights;
  for (std::size_t c = 0; c < evidence.path.size(); ++c) {
    const Eigen::Vector3d d = evidence.path.p_m[c] - plane.centroid_m;
    if (evidence.weight[c] == 0.0) continue;
    points.emplace_back(e1.dot(d), e2.dot(d));
    point_weights.push_back(evidence.weight[c]);
  }
  const CircleFit fit = fit_circle(points, point_weights);

  CircleCandidate out;
  out.axis = plane.axes.col(about);
  out.radius_m = fit.radius_m;
  out.centre_m = plane.centroid_m + fit.centre_m.x() * e1 + fit.centre_m.y() * e2;
  if (!fit.converged || !(fit.radius_m > 0.0)) return out;
  // A nearly straight path has no cylinder to rotate.
  const double extent_m = std::sqrt(plane.scatter_m2[about == 0 ? 1 : 0]);
  if (fit.radius_m < 50.0 * extent_m) {
    refine_cylinder(out, evidence, config);
  } else {
    const Eigen::Matrix3d across = across_information(out, evidence, config);
    Eigen::Matrix2d information;
    information << e1.dot(across * e1), e1.dot(across * e2), e2.dot(across * e1), e2.dot(across * e2);
    information.diagonal().array() += 1.0 / (kAxisTilt_rad * kAxisTilt_rad);
    find_lean_sigma(out, evidence, information.inverse(), e1, e2);
  }

  const double square = square_of_means(evidence, [&](std::size_t c) {
    const Eigen::Vector3d d = evidence.path.p_m[c] - out.centre_m;
    return (d - d.dot(out.axis) * out.axis).norm() - out.radius_m;
  });
  double side = 0.0;
  std::vector<Eigen::Vector3d> radial;
  for (std::size_t i = 0; i < evidence.coarse_m.size(); ++i) {
    Eigen::Vector3d d = evidence.coarse_m[i] - out.centre_m;
    d -= d.dot(out.axis) * out.axis;
    radial.push_back(d.normalized());
    side += radial.back().dot(evidence.coarse_axis[i]);
    out.fine_m2 += radial.back().dot(evidence.coarse_fine_m2[i] * radial.back());
  }
  const double count = static_cast<double>(evidence.coarse_m.size());
  out.fine_m2 /= count;
  out.rms_m = std::sqrt(square);
  out.outside = side >= 0.0;
  double tilt = 0.0;
  for (std::size_t i = 0; i < radial.size(); ++i) {
    tilt += std::pow(angle_rad(evidence.coarse_axis[i], out.outside ? radial[i] : Eigen::Vector3d(-radial[i])), 2);
  }
  out.tilt_rad = std::sqrt(tilt / count);
  // The fit takes every cell's error as independent; few are. The texture's share averages out, what lasts
  // is the coarse points' error or the slow error.
  const double inflation = std::max(config.slow_error_m, out.rms_m) / std::max(fit.rms_m, 1e-12) *
                           std::sqrt(static_cast<double>(points.size()) / evidence.independent);
  out.radius_stderr_m = fit.radius_stderr_m() * inflation;
  out.significance = 1.0 / (fit.radius_m * fit.curvature_stderr_per_m() * inflation);
  return out;
}

}  // namespace

CircleCandidate fit_circle_candidate(const PlaneCandidate& plane, const PathEvidence& evidence,
                                     const BasePathConfig& config) {
  std::vector<double> weights;
  const PlaneFit fit = fit_robust_plane(evidence.coarse_m, config.slow_error_m, weights);
  CircleCandidate best = fit_circle_about(fit, 2, evidence, config);
  if (!covers_area(evidence, config)) return best;
  double best_odds = circle_log_odds(plane, best, evidence, config);
  for (const int about : {1, 0}) {
    const CircleCandidate other = fit_circle_about(fit, about, evidence, config);
    const double odds = circle_log_odds(plane, other, evidence, config);
    if (!(odds > best_odds)) continue;
    best = other;
    best.covers_area = true;
    best_odds = odds;
  }
  return best;
}

}  // namespace asperity
