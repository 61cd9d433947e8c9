#pragma once

#include <cstdint>
#include <limits>

#include <Eigen/Core>

namespace asperity {

// A place of a model's surface that the tip touches or is about to touch.
struct SurfaceContact {
  static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

  std::uint32_t object = kNone;    // index in RenderModel::objects
  std::uint32_t triangle = kNone;  // index in the object's triangles
  Eigen::Vector3d barycentric = Eigen::Vector3d::Zero();
  Eigen::Vector3d p_world_m = Eigen::Vector3d::Zero();     // on the surface
  Eigen::Vector3d normal_world = Eigen::Vector3d::Zero();  // unit, from the surface towards the tip
  double weight = 0.0;                                     // share of the contact force; those of one tip sum to 1

  bool found() const { return triangle != kNone; }
};

}  // namespace asperity
