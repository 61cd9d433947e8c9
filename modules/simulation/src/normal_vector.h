#pragma once

#include <Eigen/Core>

#include "asperity/base/random.h"

namespace asperity {

// Three independent deviates of mean 0 and standard deviation 1, x drawn first.
inline Eigen::Vector3d normal_vector(Random& random) {
  const double x = random.normal();
  const double y = random.normal();
  return {x, y, random.normal()};
}

}  // namespace asperity
