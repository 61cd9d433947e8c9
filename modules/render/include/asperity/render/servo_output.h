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

// What a servo step renders, in the scene's world.
struct ServoOutput {
  Eigen::Vector3d force_N = Eigen::Vector3d::Zero();     // on the hand: the sum of the three below (thesis §6.5 (3))
  Eigen::Vector3d contact_N = Eigen::Vector3d::Zero();   // (4)
  Eigen::Vector3d texture_N = Eigen::Vector3d::Zero();   // (5)
  Eigen::Vector3d friction_N = Eigen::Vector3d::Zero();  // (6)
  Eigen::Vector3d proxy_m = Eigen::Vector3d::Zero();     // where the tip's centre would be on a rigid surface; where no
                                                         // object is penetrated the device point, or in a texture
                                                         // that rubs the point that friction holds back
  double texture_height_m = 0.0;                         // H at the contact (erratum 19); 0 where there is none
  SurfaceContact contact;                                // the strongest; not found where nothing is touched
  bool sticking = false;                                 // friction holds the proxy
  bool starts_inside = false;                            // no force until the tip has left the object
};

}  // namespace asperity
