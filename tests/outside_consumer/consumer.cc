#include <cmath>
#include <cstdio>

#include "asperity/base/version.h"
#include "asperity/geometry/pose.h"

int main() {
  const asperity::Pose T_a_b{asperity::exp_rotation({0.0, 0.0, std::acos(-1.0) / 2.0}), {1.0, 2.0, 3.0}};
  const Eigen::Vector3d p_a = T_a_b * Eigen::Vector3d(1.0, 0.0, 0.0);
  std::printf("asperity %s: %.3f %.3f %.3f\n", asperity::kVersion, p_a.x(), p_a.y(), p_a.z());
  return (p_a - Eigen::Vector3d(1.0, 3.0, 3.0)).norm() < 1e-12 ? 0 : 1;
}
