#pragma once

#include <array>
#include <string>

#include <Eigen/Core>

#include "asperity/base/error.h"
#include "asperity/base/text.h"

namespace asperity {

// The direction of `v`. Throws Error naming `what` if it has none.
inline Eigen::Vector3d unit_vector(const std::array<double, 3>& v, const std::string& what) {
  const Eigen::Vector3d direction(v[0], v[1], v[2]);
  Eigen::Vector3d unit = direction.stableNormalized();
  if (!(direction.cwiseAbs().maxCoeff() > 0.0) || !unit.allFinite()) {
    throw Error(what + ": [" + number_text(v[0]) + ", " + number_text(v[1]) + ", " + number_text(v[2]) +
                "] is not a direction");
  }
  return unit;
}

}  // namespace asperity
