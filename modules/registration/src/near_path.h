#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "asperity/geometry/mesh_adjacency.h"
#include "asperity/geometry/triangle_mesh.h"
#include "surface_path.h"

namespace asperity {

// Distance from a path along the mesh's edges: at least that over the surface.
struct EdgeDistance {
  double distance_m = std::numeric_limits<double>::infinity();
  double s_m = 0.0;     // of the path's point it was measured from
  double across = 1.0;  // 1 or -1, the side, as y's sign
};

// One a vertex, infinite beyond `limit_m`; along edges of the triangles marked in `within`, unless empty.
std::vector<EdgeDistance> edge_distances(const TriangleMesh& mesh, const MeshAdjacency& adjacency,
                                         std::span<const PathPiece> pieces, const std::vector<bool>& within,
                                         double limit_m);

// Marks `rings` rings of triangles that share a vertex with a marked one.
void grow_marked(const TriangleMesh& mesh, const MeshAdjacency& adjacency, int rings, std::vector<bool>& marked);

}  // namespace asperity
