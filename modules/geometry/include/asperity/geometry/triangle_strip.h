#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "asperity/geometry/mesh_adjacency.h"
#include "asperity/geometry/mesh_point.h"
#include "asperity/geometry/triangle_mesh.h"

namespace asperity {

// Triangles one after another, each joined to the next by an edge: edges[i] joins faces[i] to faces[i + 1].
struct TriangleStrip {
  std::vector<std::uint32_t> faces;
  std::vector<std::uint32_t> edges;
};

// The strip along the shortest path over three points on each edge between two points of a mesh, by A*
// (Hart, Nilsson and Raphael 1968): time and memory grow with the part of the mesh between them. Throws
// Error if no chain of neighbours connects the two triangles; indices are not checked.
TriangleStrip find_strip(const TriangleMesh& mesh, const MeshAdjacency& adjacency, const MeshPoint& from,
                         const MeshPoint& to);

}  // namespace asperity
