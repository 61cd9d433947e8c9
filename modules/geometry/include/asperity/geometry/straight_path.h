#pragma once

#include "asperity/geometry/mesh_adjacency.h"
#include "asperity/geometry/mesh_path.h"
#include "asperity/geometry/mesh_point.h"
#include "asperity/geometry/triangle_mesh.h"

namespace asperity {

// A path that bends neither left nor right on the surface.
struct StraightPath {
  MeshPath path;  // the start, every crossing of an edge, the end; piece i is in triangle i
  MeshPoint end;
  Eigen::Vector3d direction = Eigen::Vector3d::Zero();  // unit, in the plane of the end's triangle
  bool whole = true;                                    // false: the surface ended before the length did
};

// From `from` along `direction` (mesh frame; its part in the triangle's plane counts) for `length_m` over
// the surface, straight within the unfolded triangles it crosses. At an edge of more than two triangles it
// goes on in the one that bends it least. Stops at a border, at a triangle without area, and at once if the
// direction is along the normal. Throws Error for a point that is not on the mesh or a length that is
// negative or not finite.
StraightPath straight_path(const TriangleMesh& mesh, const MeshAdjacency& adjacency, const MeshPoint& from,
                           const Eigen::Vector3d& direction, double length_m);

}  // namespace asperity
