#pragma once

#include <vector>

#include <Eigen/Core>

#include "asperity/geometry/triangle_mesh.h"

namespace asperity::registration {

struct SurfaceSample {
  Eigen::Vector3d p_m;
  Eigen::Vector3d n;  // of the facet
};

// `count` points spread evenly by area, the same at each call.
std::vector<SurfaceSample> spread_over(const TriangleMesh& mesh, int count);

}  // namespace asperity::registration
