#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace asperity {

// The object's bare surface over a base, as met along the base's normal.
struct Ground {
  double height_m = 0.0;
  bool found = true;  // false: the normal misses the object
};

// What a hand scans over: a smooth base with coordinates (a, v), lengths along the main direction of the stroke
// and across it, 0 in the middle, and the object's bare surface over it. World frame.
class ScanBase {
 public:
  virtual ~ScanBase() = default;

  // The point `height_m` above (a, v) along the outward normal there.
  virtual Eigen::Vector3d point_m(double a_m, double v_m, double height_m) const = 0;
  virtual Eigen::Vector3d normal(double a_m) const = 0;  // outward, unit
  virtual Eigen::Vector3d along(double a_m) const = 0;   // unit, the direction in which a grows
  virtual Eigen::Vector3d across(double a_m) const = 0;  // unit, in which v grows: normal × along

  // The rotation of the hand that follows the normal to `a`.
  virtual Eigen::Quaterniond turn(double a_m) const = 0;

  virtual Ground ground(double a_m, double v_m) const = 0;
};

}  // namespace asperity
