#pragma once

#include <Eigen/Geometry>

#include "asperity/geometry/pose.h"

namespace asperity {

// Steps over a surface rolled into a plane: the tangent plane's axes go along without turning about the
// normal. A step keeps its length, also where it runs over an edge that the interpolated normal rounds.
class Development {
 public:
  Eigen::Vector2d add(const Eigen::Vector3d& p_m, const Eigen::Vector3d& normal) {
    if (!started_) {
      e1_ = normal.unitOrthogonal();
      normal_ = normal;
      p_m_ = p_m;
      started_ = true;
      return u_m_;
    }
    const Eigen::Vector3d step_m = p_m - p_m_;
    e1_ = shortest_rotation(normal_, normal) * e1_;
    e1_ = (e1_ - e1_.dot(normal) * normal).normalized();
    Eigen::Vector2d flat_m(e1_.dot(step_m), normal.cross(e1_).dot(step_m));
    const double flat = flat_m.norm();
    if (flat > 0.0) flat_m *= step_m.norm() / flat;
    u_m_ += flat_m;
    normal_ = normal;
    p_m_ = p_m;
    return u_m_;
  }

 private:
  bool started_ = false;
  Eigen::Vector3d e1_, normal_, p_m_;
  Eigen::Vector2d u_m_ = Eigen::Vector2d::Zero();
};

}  // namespace asperity
