#pragma once

#include <span>

#include "asperity/base/config.h"
#include "asperity/geometry/mesh_bvh.h"
#include "asperity/geometry/pose.h"
#include "asperity/registration/registration_result.h"

namespace asperity {

struct ThesisRegistrationConfig {
  double spacing_m = 0.5e-3;
  // Point-to-point steps slide slowly: with 1e-3 they end after some 100 steps, on the way, several degrees from where
  // the distance is least.
  double relative_change = 1e-5;
  int max_iterations = 5000;
  // The thesis has no such step. Resampled at equal distances, the centimetres of path that lead to a flipped pose and
  // back have as many points as the scan.
  bool reject_flips = true;

  template <class V>
  void visit(V& v) {
    v.field("spacing_m", spacing_m, "between the points of the resampled path, m", {1e-9, 1e3});
    v.field("relative_change", relative_change, "of the mean distance from step to step at which it stops", {0.0, 1.0});
    v.field("max_iterations", max_iterations, "limit", {1, 100000});
    v.field("reject_flips", reject_flips, "poses far from the median of their neighbours are left out before");
  }
};

// The thesis's registration (thesis §5.4, A.2, B.2, errata 16 and 26): the paths resampled at equal distances, the
// closest points on the mesh's triangles, absolute orientation in closed form, repeated until the mean
// distance changes by less than relative_change of itself (error_change) or max_iterations is reached. It
// judges neither what is determined nor other solutions. Throws Error for fewer than three points after
// resampling, a point that is not finite (naming it), or a path of more than ten million spacings.
RegistrationResult register_thesis(std::span<const MeasuredPath> paths, const MeshBvh& bvh, const Pose& guess,
                                   const ThesisRegistrationConfig& config);

}  // namespace asperity
