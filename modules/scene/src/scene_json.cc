#include "scene_json.h"

#include <array>
#include <cmath>

namespace asperity {

Pose parse_pose(const JsonItem& item) {
  constexpr double kFarthest_m = 1e6, kNormTolerance = 1e-6;
  std::array<double, 7> v{};
  item.numbers(v.data(), v.size(), {-kFarthest_m, kFarthest_m});
  const Eigen::Quaterniond q(v[3], v[4], v[5], v[6]);
  if (!(std::abs(q.norm() - 1.0) < kNormTolerance)) item.fail("has a quaternion that is not of unit length");
  return {q, {v[0], v[1], v[2]}};
}

Json format_pose(const Pose& pose) {
  const Eigen::Vector3d& p = pose.translation_m;
  const Eigen::Quaterniond& q = pose.rotation;
  return {p.x(), p.y(), p.z(), q.w(), q.x(), q.y(), q.z()};
}

}  // namespace asperity
