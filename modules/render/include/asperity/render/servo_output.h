#pragma once

#include <Eigen/Core>

#include "asperity/render/surface_contact.h"

namespace asperity {

// What a servo step renders, in the scene's world.
struct ServoOutput {
  Eigen::Vector3d force_N = Eigen::Vector3d::Zero();     // on the hand: the sum of the three below (seed §6.5 (3))
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
