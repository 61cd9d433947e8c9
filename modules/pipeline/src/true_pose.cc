#include "asperity/pipeline/true_pose.h"

namespace asperity {

std::optional<Pose> true_pose(const Recording& recording) {
  std::optional<Pose> out = recording.info.T_mesh_world;
  if (out) out->rotation.normalize();
  return out;
}

}  // namespace asperity
