#pragma once

#include <Eigen/Core>

#include "asperity/simulation/scan_base.h"
#include "asperity/simulation/surface_config.h"

namespace asperity {

// The base shape under the relief: a plane, or a cylinder whose axis is across the stroke. The object's surface
// is the base itself.
class SimulatedShape final : public ScanBase {
 public:
  // The hand follows `follow_normal` of the normal's turn. Throws Error if the normal is zero, the stroke's
  // direction is along it, or the kind is a mesh (mesh_base.h).
  explicit SimulatedShape(const SimulatedShapeConfig& config, double follow_normal = 0.0);

  Eigen::Vector3d point_m(double a_m, double v_m, double height_m) const override;
  Eigen::Vector3d normal(double a_m) const override;
  Eigen::Vector3d along(double a_m) const override;
  Eigen::Vector3d across(double) const override { return across_; }
  Eigen::Quaterniond turn(double a_m) const override;
  Ground ground(double, double) const override { return {}; }

  // The rotation of the normal about across(), rad, from the middle to `a`.
  double turn_rad(double a_m) const { return curvature_per_m_ * a_m; }

 private:
  Eigen::Vector3d centre_m_, along_, across_, normal_;
  double curvature_per_m_ = 0.0;
  double follow_normal_ = 0.0;
};

}  // namespace asperity
