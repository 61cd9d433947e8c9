#pragma once

#include <cstddef>
#include <optional>

#include "asperity/verdict/verdict.h"

namespace asperity {

// What a registration shows of itself.
struct PoseEvidence {
  bool converged = true;
  int iterations = 0;
  std::size_t points = 0;
  std::size_t outliers = 0;  // of the points: not on the mesh
  bool ambiguous = false;    // another pose fits as well
  double rival_distance_m = 0.0;
  double rival_rotation_rad = 0.0;
};

// The verdicts on the pose of scans on a mesh, the worst first.
Verdicts judge_registration(const PoseEvidence& evidence);

}  // namespace asperity
