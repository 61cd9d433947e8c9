#include "asperity/import/pose_noise.h"

#include "asperity/base/units.h"
#include "asperity/signal/white_noise.h"

namespace asperity {

PoseNoise estimate_pose_noise(const PoseStream& pose) {
  if (pose.size() == 0) return {};
  std::vector<double> t_s;
  std::vector<Eigen::Vector3d> p_m;
  for (std::size_t i = 0; i < pose.size(); ++i) {
    t_s.push_back(static_cast<double>(pose.t_ns[i] - pose.t_ns.front()) * kNanosecond_s);
    p_m.push_back(pose.T_world_body[i].translation_m);
  }
  const auto from_middle = [&](std::size_t i, std::size_t k) -> Eigen::Vector3d {
    return log_rotation(pose.T_world_body[k].rotation * pose.T_world_body[i].rotation.conjugate());
  };
  PoseNoise out;
  out.position_m = white_noise(t_s, p_m);
  out.rotation_rad = white_noise(t_s, [&](std::size_t i) -> Eigen::Vector3d {
    return from_middle(i, i - 2) - 4.0 * from_middle(i, i - 1) - 4.0 * from_middle(i, i + 1) + from_middle(i, i + 2);
  });
  return out;
}

}  // namespace asperity
