#include "quaternion_check.h"

#include <cmath>

namespace asperity {

QuaternionState make_unit(Eigen::Quaterniond& q) {
  constexpr double kExact = 1e-15;  // more than normalising can leave
  constexpr double kRounding = 1e-6;
  constexpr double kSloppy = 1e-3;
  const double off = std::abs(q.norm() - 1.0);
  if (!(off <= kSloppy)) return QuaternionState::kUnusable;
  if (off > kExact) q.normalize();
  return off > kRounding ? QuaternionState::kRepaired : QuaternionState::kUnit;
}

}  // namespace asperity
