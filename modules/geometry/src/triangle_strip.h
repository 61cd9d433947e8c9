#pragma once

#include <cstdint>
#include <vector>

#include "asperity/geometry/mesh_adjacency.h"
#include "asperity/geometry/mesh_path.h"
#include "asperity/geometry/mesh_point.h"

namespace asperity {

// Triangles one after another, each joined to the next by an edge: edges[i] joins faces[i] to faces[i + 1].
struct TriangleStrip {
  std::vector<std::uint32_t> faces;
  std::vector<std::uint32_t> edges;
};

// The first strip between two triangles: that of the shortest path over points on the edges. Throws Error
// if there is none.
TriangleStrip first_strip(const TriangleMesh& mesh, const MeshAdjacency& adjacency, const MeshPoint& from,
                          const MeshPoint& to);

// The edge joining faces[i] to faces[i + 1], unfolded: its left end as seen along the strip, and its right.
struct Portal {
  Eigen::Vector2d left;
  Eigen::Vector2d right;
  std::uint32_t left_vertex;
  std::uint32_t right_vertex;
};

// A strip laid flat: every triangle keeps its shape.
struct UnfoldedStrip {
  std::vector<Portal> portals;
  Eigen::Vector2d from;
  Eigen::Vector2d to;
};

UnfoldedStrip unfold(const TriangleMesh& mesh, const MeshAdjacency& adjacency, const TriangleStrip& strip,
                     const Eigen::Vector3d& from, const Eigen::Vector3d& to);

// Where the shortest path within a strip bends: round an end of a portal.
struct Bend {
  std::size_t portal;
  bool left;
};

// The bends of the shortest path from `from` to `to` through all portals, in order: the funnel of Lee and
// Preparata (1984), in the form that starts anew at each bend.
std::vector<Bend> shortest_bends(const UnfoldedStrip& strip);

}  // namespace asperity
