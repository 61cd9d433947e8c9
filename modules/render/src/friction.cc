#include "friction.h"

#include <algorithm>

namespace asperity {

using Eigen::Vector3d;

bool sticks(const Friction& friction, bool stuck, const Vector3d& lag_m) noexcept {
  const double bears_N = (stuck ? friction.sticking : friction.sliding) * friction.load_N;
  return bears_N > 0.0 && friction.stiffness_N_per_m * lag_m.norm() <= bears_N;
}

Vector3d sliding_lag_m(const Friction& friction, const Vector3d& lag_m) noexcept {
  const double along_N = friction.stiffness_N_per_m * lag_m.norm();
  const double bears_N = friction.sliding * friction.load_N;
  if (along_N <= bears_N) return lag_m;
  return (bears_N / along_N) * lag_m;
}

Vector3d friction_force_N(const Friction& friction, bool stuck, const Vector3d& lag_m, double load_before_N) noexcept {
  const double along_N = friction.stiffness_N_per_m * lag_m.norm();
  const double bears_N = (stuck ? friction.sticking : friction.sliding) * friction.load_N;
  if (!(along_N > 0.0) || !(load_before_N > 0.0)) return Vector3d::Zero();
  const double wanted_N = stuck ? along_N : along_N * (friction.load_N / load_before_N);
  return (friction.stiffness_N_per_m * (std::min(wanted_N, bears_N) / along_N)) * lag_m;
}

}  // namespace asperity
