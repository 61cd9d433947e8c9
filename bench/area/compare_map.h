#pragma once

#include <limits>
#include <vector>

#include <Eigen/Core>

#include "asperity/geometry/triangle_mesh.h"
#include "asperity/pipeline/make_area.h"
#include "rough_patch.h"

namespace bench {

struct MapPoint {
  Eigen::Vector3d p_mesh_m;
  double height_m, sigma_m;
  bool covered;
};

// Points of the textured triangles, a few each, with the map's heights there.
std::vector<MapPoint> map_points(const asperity::AreaResult& area, const asperity::TriangleMesh& mesh);

struct Comparison {
  double error_m = std::numeric_limits<double>::infinity(), ratio = 0.0, sigma_m = 0.0, truth_m = 0.0,
         correlation = 0.0;
};

// Map less truth, the truth moved by `shift_m`, a quadratic over the patch taken off: that is the pose's share and the
// mesh's, below the map's band.
Comparison compare(const std::vector<MapPoint>& points, const UnderTip& truth, const Eigen::Vector2d& shift_m);

}  // namespace bench
