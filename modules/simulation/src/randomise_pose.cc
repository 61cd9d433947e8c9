#include "asperity/simulation/randomise_pose.h"

#include <numbers>

#include <Eigen/Geometry>

#include "asperity/base/random.h"
#include "asperity/geometry/pose.h"

namespace asperity {

void randomise_pose(std::uint64_t seed, SimulatedShapeConfig& shape) {
  constexpr double kFarthest_m = 0.03;
  constexpr double kTilt_rad = 20.0 * std::numbers::pi / 180.0;
  constexpr double kTurn_rad = 60.0 * std::numbers::pi / 180.0;
  Random random(seed);
  for (double& centre_m : shape.centre_m) centre_m += random.uniform(-kFarthest_m, kFarthest_m);

  Eigen::Map<Eigen::Vector3d> normal(shape.normal.data()), direction(shape.stroke_direction.data());
  const Eigen::Vector3d n = normal.normalized(), sideways = n.unitOrthogonal();
  const double towards_rad = random.uniform(0.0, 2.0 * std::numbers::pi);
  const Eigen::Quaterniond tilt =
      exp_rotation(random.uniform(0.0, kTilt_rad) * (exp_rotation(towards_rad * n) * sideways));
  const Eigen::Quaterniond turn = tilt * exp_rotation(random.uniform(-kTurn_rad, kTurn_rad) * n);
  normal = (tilt * n).normalized();
  direction = (turn * direction.normalized()).normalized();
}

}  // namespace asperity
