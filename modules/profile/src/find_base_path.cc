#include "asperity/profile/find_base_path.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include "asperity/base/error.h"
#include "asperity/base/text.h"
#include "asperity/signal/statistics.h"
#include "base_curve.h"
#include "development.h"
#include "estimate_lean.h"
#include "fit_base_shape.h"
#include "fit_curved_surface.h"
#include "motion_times.h"
#include "path_evidence.h"
#include "robust_plane.h"

namespace asperity {

namespace {

constexpr double kSureShape = 0.9;
constexpr double kLeaningSigmas = 1.5;  // of how far a probe is held from the normal: 30 degrees by default
constexpr double kRadian_deg = 180.0 / std::numbers::pi;

// Base points and normals on the plane; returns the developed coordinates.
std::vector<Eigen::Vector2d> develop_plane(const PlaneCandidate& plane, const TipMotion& motion, BasePath& path) {
  const Eigen::Vector3d e1 = plane.normal.unitOrthogonal(), e2 = plane.normal.cross(e1);
  std::vector<Eigen::Vector2d> u;
  u.reserve(motion.size());
  for (const Eigen::Vector3d& p : motion.p_world_tip_m) {
    const Eigen::Vector3d d = p - plane.point_m;
    path.p_world_m.push_back(p - d.dot(plane.normal) * plane.normal);
    path.n_world.push_back(plane.normal);
    u.emplace_back(e1.dot(d), e2.dot(d));
  }
  return u;
}

// The same on the cylinder: R times the angle, and the distance along the axis.
std::vector<Eigen::Vector2d> develop_circle(const CircleCandidate& circle, const TipMotion& motion, BasePath& path) {
  const Eigen::Vector3d e1 = circle.axis.unitOrthogonal();
  std::vector<Eigen::Vector2d> u;
  u.reserve(motion.size());
  double angle = 0.0;
  Eigen::Vector3d before = e1;
  for (const Eigen::Vector3d& p : motion.p_world_tip_m) {
    const Eigen::Vector3d d = p - circle.centre_m;
    const double along = d.dot(circle.axis);
    const Eigen::Vector3d across = d - along * circle.axis;
    const Eigen::Vector3d radial = across.norm() > 0.0 ? Eigen::Vector3d(across.normalized()) : before;
    angle += std::atan2(circle.axis.dot(before.cross(radial)), before.dot(radial));
    before = radial;
    path.p_world_m.push_back(circle.centre_m + along * circle.axis + circle.radius_m * radial);
    path.n_world.push_back(circle.outside ? radial : Eigen::Vector3d(-radial));
    u.emplace_back(circle.radius_m * angle, along);
  }
  return u;
}

// The same on a doubly curved surface, steps rolled into a plane.
std::vector<Eigen::Vector2d> develop_curved(const CurvedSurface& surface, const TipMotion& motion, BasePath& path) {
  std::vector<Eigen::Vector2d> u;
  u.reserve(motion.size());
  Development development;
  for (const Eigen::Vector3d& p : motion.p_world_tip_m) {
    const CurvedSurface::Foot foot = surface.foot(p);
    path.p_world_m.push_back(foot.p_m);
    path.n_world.push_back(foot.normal);
    u.push_back(development.add(foot.p_m, foot.normal));
  }
  return u;
}

std::vector<Eigen::Vector2d> develop_curve(const PathEvidence& evidence, const std::vector<double>& t_s,
                                           const TipMotion& motion, double cutoff_cycles_per_mm, BasePath& path) {
  const BaseCurve curve = make_base_curve(evidence, cutoff_cycles_per_mm);
  std::vector<Eigen::Vector2d> u;
  u.reserve(motion.size());
  for (const CurvePoint& point : project_on_curve(curve, evidence, t_s, motion.p_world_tip_m)) {
    path.p_world_m.push_back(point.p_m);
    path.n_world.push_back(point.normal);
    u.emplace_back(point.s_m, 0.0);
  }
  return u;
}

// The unit vector across travel and normal of each sample, along the path's slow motion and on one side of it.
std::vector<Eigen::Vector3d> find_across(const PathEvidence& evidence, const std::vector<double>& t_s,
                                         const BasePath& path) {
  constexpr double kSlow_Hz = 3.0;  // below a hand's tremor
  const EvenPath<3> slow = low_pass(evidence.path, kSlow_Hz);
  std::vector<Eigen::Vector3d> out;
  out.reserve(t_s.size());
  Eigen::Vector3d before = path.n_world.front().unitOrthogonal();
  for (std::size_t i = 0; i < t_s.size(); ++i) {
    const std::size_t c = index_at(evidence.path, t_s[i]);
    const Eigen::Vector3d side = path.n_world[i].cross(velocity_mps(slow, c));
    // Where the tip rests it is as before; forth and back are one line.
    if (evidence.weight[c] > 0.0 && side.norm() > 0.0) before = (side.dot(before) < 0.0 ? -side : side).normalized();
    Eigen::Vector3d across = before - before.dot(path.n_world[i]) * path.n_world[i];
    if (!(across.norm() > 1e-6)) across = path.n_world[i].unitOrthogonal();
    out.push_back(across.normalized());
  }
  return out;
}

// Normals turned by the lean; the base is then what has them and holds the line that it had.
void turn_normals(const TipMotion& motion, const LeanAxes& axes, const Lean& lean, const Eigen::Vector3d* centre_m,
                  BasePath& path) {
  for (std::size_t i = 0; i < path.size(); ++i) {
    const double phi = lean.lean_rad + (axes.change.empty() ? 0.0 : lean.change_rad * axes.change[i]);
    const double c = std::cos(phi), s = std::sin(phi);
    const Eigen::Vector3d& p = motion.p_world_tip_m[i];
    const Eigen::Vector3d from_base_m = p - path.p_world_m[i];
    const double rise_m = path.n_world[i].dot(from_base_m);
    const double side_m = axes.across[i].dot(centre_m == nullptr ? from_base_m : Eigen::Vector3d(p - *centre_m));
    path.n_world[i] = (c * path.n_world[i] + s * axes.across[i]).normalized();
    path.p_world_m[i] = p - (c * rise_m + s * side_m) * path.n_world[i];
  }
}

// Across a circle's path is its axis. An axis that is turned about the path's middle normal lets the normals lean one
// way at its begin and the other at its end.
LeanAxes axes_of(const CircleCandidate& circle, const PathEvidence& evidence, const BasePath& path) {
  LeanAxes out{std::vector<Eigen::Vector3d>(path.size(), circle.axis), {}};
  const auto radial = [&](const Eigen::Vector3d& p_m) -> Eigen::Vector3d {
    const Eigen::Vector3d d = p_m - circle.centre_m;
    return (d - d.dot(circle.axis) * circle.axis).normalized();
  };
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  const double count = static_cast<double>(evidence.coarse_m.size());
  for (const Eigen::Vector3d& p_m : evidence.coarse_m) middle += radial(p_m) / count;
  const Eigen::Vector3d along = circle.axis.cross(middle).normalized();
  double square = 0.0;
  for (const Eigen::Vector3d& p_m : evidence.coarse_m) square += std::pow(along.dot(radial(p_m)), 2) / count;
  if (!(square > 0.0)) return out;
  for (const Eigen::Vector3d& n : path.n_world)
    out.change.push_back(std::clamp(along.dot(n) / std::sqrt(square), -3.0, 3.0));
  return out;
}

// The circle's centre where the path in contact is about, along its axis.
void centre_along_axis(const PathEvidence& evidence, CircleCandidate& circle) {
  double sum_m = 0.0, weight = 0.0;
  for (std::size_t c = 0; c < evidence.path.size(); ++c) {
    sum_m += evidence.weight[c] * circle.axis.dot(evidence.path.p_m[c] - circle.centre_m);
    weight += evidence.weight[c];
  }
  if (weight > 0.0) circle.centre_m += sum_m / weight * circle.axis;
}

PathShape choose_shape(const PlaneCandidate& plane, const CircleCandidate& circle, const CurvedSurface* curved,
                       const PathEvidence& evidence, const BasePathConfig& config, double& probability) {
  if (config.shape != PathShape::kAuto) return config.shape;
  const double odds = circle_log_odds(plane, circle, evidence, config);
  probability = 1.0 / (1.0 + std::exp(-std::abs(odds)));
  const bool round = odds > 0.0;
  const double rms_m = round ? circle.rms_m : plane.rms_m;
  if (curved != nullptr) {
    const double curved_odds = curved_log_odds(*curved, rms_m, round, evidence, config);
    if (curved_odds > 0.0 && curved->rms_m < config.shape_tolerance_m) {
      probability = 1.0 / (1.0 + std::exp(-curved_odds));
      return PathShape::kDoublyCurved;
    }
  }
  if (rms_m > std::max(config.shape_tolerance_m, 5.0 * config.slow_error_m)) {
    probability = 1.0;
    return PathShape::kCurve;
  }
  // A path that bends on a plane and one around a body are the same points with normals far apart. Where neither is
  // certain and the likelier one has the probe lean more than hands do, the normals are the probe's.
  const double tilt_deg = kRadian_deg * (round ? circle.tilt_rad : plane.tilt_rad);
  if (probability < kSureShape && tilt_deg > kLeaningSigmas * config.probe_axis_sigma_deg) return PathShape::kCurve;
  return round ? PathShape::kCircle : PathShape::kPlane;
}

// An axis' standard deviation by the motion's own covariance, median; without the tip's place in the marker, which is
// one error of all samples. 0 if the method gives none.
double position_sigma_m(const TipMotion& motion) {
  std::vector<double> variance_m2;
  for (const Eigen::Matrix3d& cov : motion.cov_world_tip_m2) variance_m2.push_back(cov.trace() / 3.0);
  if (variance_m2.empty()) return 0.0;
  return std::sqrt(std::max(0.0, median(variance_m2) - motion.sigma_tip_in_marker_m.squaredNorm() / 3.0));
}

// The furthest of the points from the first, and what lies furthest from that.
double extent_m(const std::vector<Eigen::Vector3d>& points_m) {
  const auto furthest = [&](const Eigen::Vector3d& from_m) {
    return *std::max_element(points_m.begin(), points_m.end(), [&](const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
      return (a - from_m).squaredNorm() < (b - from_m).squaredNorm();
    });
  };
  const Eigen::Vector3d end_m = furthest(points_m.front());
  return (furthest(end_m) - end_m).norm();
}

}  // namespace

BasePathResult find_base_path(const TipMotion& motion, const Eigen::Vector3d& tip_in_marker_m,
                              const BasePathConfig& stated) {
  BasePathConfig config = stated;
  config.slow_error_m = std::max(stated.slow_error_m, position_sigma_m(motion));
  const std::vector<double> t_s = motion_times_s(motion);
  if (!tip_in_marker_m.allFinite()) throw Error("base path: tip_in_marker_m is not finite");
  if (config.shape == PathShape::kMesh) throw Error("base path: the shape 'mesh' needs a registered mesh");
  BasePathResult out;
  out.contact = find_contact(motion, config.contact);
  const PathEvidence evidence = gather_evidence(motion, t_s, out.contact, tip_in_marker_m, config);
  const bool axis_known = tip_in_marker_m.norm() > 0.0;
  if (!axis_known) {
    out.problems.push_back({"no_probe_axis", "the tip is at the marker's origin: the outward side is not known"});
  }

  PlaneCandidate plane = fit_plane_candidate(evidence, config);
  CircleCandidate circle = fit_circle_candidate(plane, evidence, config);
  std::optional<CurvedSurface> curved;
  if (config.shape == PathShape::kDoublyCurved ||
      (config.shape == PathShape::kAuto && evidence.force_measured && covers_area(evidence, config))) {
    curved = fit_curved_surface(plane, evidence, config);
  }
  out.shape = choose_shape(plane, circle, curved ? &*curved : nullptr, evidence, config, out.shape_probability);

  out.path.p_world_m.reserve(motion.size());
  out.path.n_world.reserve(motion.size());
  std::vector<Eigen::Vector2d> developed;
  // What the motion itself says of the normals, over what the shape's fit does.
  const double texture_axis_sigma_rad = config.texture_axis_sigma_deg / kRadian_deg;
  const auto find_lean = [&](const LeanAxes& axes, double prior_rad, double change_rad = 0.0) {
    return estimate_lean(motion, t_s, out.contact, evidence, out.path, axes,
                         {prior_rad, change_rad, texture_axis_sigma_rad});
  };
  if (out.shape == PathShape::kCircle) {
    if (!(circle.radius_m > 0.0) || !(circle.significance > 0.0))
      throw Error("base path: no circle fits a path without curvature");
    centre_along_axis(evidence, circle);
    developed = develop_circle(circle, motion, out.path);
    const LeanAxes axes = axes_of(circle, evidence, out.path);
    // Rows along the axis do not travel across it, as the lean by the motion supposes.
    const Lean lean = circle.covers_area ? Lean{0.0, std::hypot(circle.lean_sigma_rad, circle.lean_change_rad), 0.0}
                                         : find_lean(axes, circle.lean_sigma_rad, circle.lean_change_rad);
    turn_normals(motion, axes, lean, &circle.centre_m, out.path);
    out.lean_rad = lean.lean_rad;
    out.centre_world_m = circle.centre_m;
    out.axis_world = circle.axis;
    out.radius_m = circle.radius_m;
    out.radius_stderr_m = circle.radius_stderr_m;
    out.outside = circle.outside;
    out.probe_tilt_deg = kRadian_deg * circle.tilt_rad;
    out.base_rms_m = circle.rms_m;
    // A radius that is off by δ over a chord L turns the normals at its ends by about L/2 · δ/R².
    const double half_m = 0.5 * extent_m(evidence.coarse_m);
    const double ends_rad = half_m * circle.radius_stderr_m / (circle.radius_m * circle.radius_m);
    out.normal_sigma_deg = kRadian_deg * std::hypot(lean.sigma_rad, ends_rad);
  } else if (out.shape == PathShape::kDoublyCurved) {
    developed = develop_curved(*curved, motion, out.path);
    out.centre_world_m = curved->point_m;
    out.axis_world = curved->axes.col(2);
    const Eigen::Vector2d eigenvalues =
        Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(-curved->curvature_per_m).eigenvalues();
    out.curvatures_per_m = Eigen::Vector2d(eigenvalues(1), eigenvalues(0));
    out.normal_sigma_deg = kRadian_deg * curved->normal_sigma_rad;
    double square = 0.0;
    for (std::size_t i = 0; i < evidence.coarse_m.size(); ++i)
      square += std::pow(angle_rad(evidence.coarse_axis[i], curved->foot(evidence.coarse_m[i]).normal), 2);
    out.probe_tilt_deg = kRadian_deg * std::sqrt(square / static_cast<double>(evidence.coarse_m.size()));
    out.base_rms_m = curved->rms_m;
  } else if (out.shape == PathShape::kCurve) {
    developed = develop_curve(evidence, t_s, motion, config.curve_cutoff_cycles_per_mm, out.path);
    const LeanAxes axes{find_across(evidence, t_s, out.path), {}};
    const Lean lean = find_lean(axes, config.probe_axis_sigma_deg / kRadian_deg);
    turn_normals(motion, axes, lean, nullptr, out.path);
    out.lean_rad = lean.lean_rad;
    out.normal_sigma_deg = kRadian_deg * lean.sigma_rad;
    double square = 0.0;
    for (const Eigen::Vector3d& p : evidence.coarse_m) square += std::pow(plane.normal.dot(p - plane.point_m), 2);
    out.base_rms_m = std::sqrt(square / static_cast<double>(evidence.coarse_m.size()));
  } else {
    developed = develop_plane(plane, motion, out.path);
    const Eigen::Vector3d across = plane.normal.cross(plane.stroke).normalized();
    const Lean lean = find_lean({std::vector<Eigen::Vector3d>(motion.size(), across), {}}, plane.sigma_rad);
    plane.normal = (std::cos(lean.lean_rad) * plane.normal + std::sin(lean.lean_rad) * across).normalized();
    plane.sigma_rad = lean.sigma_rad;
    out.path.p_world_m.clear();
    out.path.n_world.clear();
    developed = develop_plane(plane, motion, out.path);
    out.centre_world_m = plane.point_m;
    out.axis_world = plane.normal;
    out.normal_sigma_deg = kRadian_deg * plane.sigma_rad;
    out.probe_tilt_deg = kRadian_deg * plane.tilt_rad;
    out.base_rms_m = plane.rms_m;
  }
  if (out.normal_sigma_deg > config.undetermined_deg) {
    out.undetermined.push_back({"normal about the direction of travel", out.normal_sigma_deg});
  }
  for (const UndeterminedRotation& u : out.undetermined) {
    out.problems.push_back(
        {"undetermined_normal",
         u.description + ": standard deviation " + number_text(std::round(u.sigma_deg * 10.0) / 10.0) + " degrees"});
  }
  if (out.shape_probability < kSureShape && out.shape == PathShape::kCurve) {
    out.problems.push_back({"uncertain_shape", "neither a plane nor a circle is certain (probability " +
                                                   number_text(std::round(out.shape_probability * 100.0) / 100.0) +
                                                   "), and the probe leans far: the normals are the probe's"});
  } else if (out.shape_probability < kSureShape) {
    out.problems.push_back({"uncertain_shape", "base shape " +
                                                   std::string(kPathShapeNames[static_cast<std::size_t>(out.shape)]) +
                                                   " chosen with probability " +
                                                   number_text(std::round(out.shape_probability * 100.0) / 100.0)});
  }

  if (!evidence.force_measured) {
    for (std::size_t i = 0; i < motion.size(); ++i) {
      const double height_m = out.path.n_world[i].dot(motion.p_world_tip_m[i] - out.path.p_world_m[i]);
      if (std::abs(height_m) > config.max_height_m) out.contact[i] = 0;
    }
  }
  follow_path(motion, t_s, developed, config, out);
  if (out.shape == PathShape::kCurve && !out.turning_points.empty()) {
    out.problems.push_back(
        {"curve_with_turns", "a base curve is not reliable near reversals", out.turning_points.size()});
  }
  return out;
}

}  // namespace asperity
