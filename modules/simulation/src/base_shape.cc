#include "asperity/simulation/base_shape.h"

#include <Eigen/Geometry>
#include <cmath>

#include "asperity/base/error.h"
#include "asperity/geometry/pose.h"

namespace asperity {

SimulatedShape::SimulatedShape(const SimulatedShapeConfig& config, double follow_normal)
    : centre_m_(config.centre_m.data()), follow_normal_(follow_normal) {
  if (config.kind == BaseShapeKind::kMesh) throw Error("simulation.shape.kind: a mesh is not a plane or cylinder");
  const Eigen::Vector3d normal(config.normal.data());
  const Eigen::Vector3d stroke(config.stroke_direction.data());
  if (!(normal.norm() > 0.0)) throw Error("simulation.shape.normal: must not be zero");
  normal_ = normal.normalized();
  const Eigen::Vector3d along = stroke - normal_ * normal_.dot(stroke);
  if (!(along.norm() > 1e-6 * stroke.norm()))
    throw Error("simulation.shape.stroke_direction: must not be along shape.normal");
  along_ = along.normalized();
  across_ = normal_.cross(along_);
  if (config.kind == BaseShapeKind::kCylinder) curvature_per_m_ = 1.0 / config.cylinder_radius_m;
}

Eigen::Vector3d SimulatedShape::normal(double a_m) const {
  const double turn = turn_rad(a_m);
  return std::cos(turn) * normal_ + std::sin(turn) * along_;
}

Eigen::Vector3d SimulatedShape::along(double a_m) const {
  const double turn = turn_rad(a_m);
  return std::cos(turn) * along_ - std::sin(turn) * normal_;
}

Eigen::Quaterniond SimulatedShape::turn(double a_m) const {
  return exp_rotation(follow_normal_ * turn_rad(a_m) * across_);
}

Eigen::Vector3d SimulatedShape::point_m(double a_m, double v_m, double height_m) const {
  if (curvature_per_m_ == 0.0) return centre_m_ + a_m * along_ + v_m * across_ + height_m * normal_;
  const double radius_m = 1.0 / curvature_per_m_;
  const double turn = turn_rad(a_m);
  // 1 − cos by the half angle keeps its digits near the middle.
  const double half = std::sin(0.5 * turn);
  return centre_m_ + v_m * across_ + (radius_m + height_m) * std::sin(turn) * along_ +
         (height_m * std::cos(turn) - 2.0 * radius_m * half * half) * normal_;
}

}  // namespace asperity
