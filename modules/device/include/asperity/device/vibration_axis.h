#pragma once

#include <cstdint>

#include <Eigen/Core>

namespace asperity {

// The vibration in a force as one number, linear in it: the part along the contact's slow direction and the part along
// the motion. The length of the force would be a rectifier: what trembles across it would be lost.
class VibrationAxis {
 public:
  // The number of this tick, in newtons; 0 for a force that is not finite or a velocity beyond 1000 m/s. Realtime-safe:
  // yes.
  double push(const Eigen::Vector3d& force_N, const Eigen::Vector3d& v_mps, std::int64_t t_ns) noexcept;

 private:
  Eigen::Vector3d force_N_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d v_mps_ = Eigen::Vector3d::Zero();
  std::int64_t last_ns_ = 0;
};

}  // namespace asperity
