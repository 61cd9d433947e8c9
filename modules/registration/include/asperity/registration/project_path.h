#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

#include "asperity/geometry/mesh_bvh.h"
#include "asperity/geometry/mesh_path.h"
#include "asperity/geometry/pose.h"
#include "asperity/geometry/triangle_mesh.h"

namespace asperity {

// A scan path laid on a mesh: entry i of each vector belongs to point i.
struct PathProjection {
  MeshPath path;                             // the closest points; s_m along the chords between them
  std::vector<Eigen::Vector3d> barycentric;  // of each in its triangle
  std::vector<double> distance_m;            // of the point from the surface, positive on the outer side
};

// The closest points of a registered path (seed §5.4, Fig. 24; B.2). Throws Error for a point that is not finite
// under the pose, naming it.
PathProjection project_path(std::span<const Eigen::Vector3d> p_world_m, const TriangleMesh& mesh, const MeshBvh& bvh,
                            const Pose& T_mesh_world);

}  // namespace asperity
