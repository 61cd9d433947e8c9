#include "asperity/simulation/random_motion.h"

#include "asperity/base/random.h"

namespace asperity {

Pose random_motion(double shift_m, double turn_rad, const Eigen::Vector3d& centre_m, std::uint64_t seed) {
  Random random(seed);
  const auto direction = [&] {
    const double x = random.normal(), y = random.normal(), z = random.normal();
    return Eigen::Vector3d(x, y, z).normalized();
  };
  const Eigen::Quaterniond turn = exp_rotation(turn_rad * direction());
  return {turn, centre_m - turn * centre_m + shift_m * direction()};
}

}  // namespace asperity
