#pragma once

#include <Eigen/Core>

#include "asperity/simulation/surface_config.h"

namespace asperity {

// The base shape under the relief: a plane, or a cylinder whose axis lies across the stroke. Points on it
// are (a, v): lengths along the main direction of the stroke and across it, 0 in the middle.
class SimulatedShape {
 public:
  // Throws Error if the normal is zero or the stroke's direction is along it.
  explicit SimulatedShape(const SimulatedShapeConfig& config);

  // The point `height_m` above (a, v) along the outward normal there, world frame.
  Eigen::Vector3d point_m(double a_m, double v_m, double height_m) const;
  Eigen::Vector3d normal(double a_m) const;           // outward, unit, world frame
  Eigen::Vector3d along(double a_m) const;            // unit, the direction in which a grows
  Eigen::Vector3d across() const { return across_; }  // unit, in which v grows: normal × along

  // The turn of the normal about across(), rad, from the middle to `a`.
  double turn_rad(double a_m) const { return curvature_per_m_ * a_m; }

 private:
  Eigen::Vector3d centre_m_, along_, across_, normal_;
  double curvature_per_m_ = 0.0;
};

}  // namespace asperity
