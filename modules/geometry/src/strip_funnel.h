#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "asperity/geometry/mesh_adjacency.h"
#include "asperity/geometry/triangle_strip.h"

namespace asperity {

// The edge joining faces[i] to faces[i + 1] of a strip, unfolded: its left end as seen along the strip, and
// its right.
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

UnfoldedStrip unfold_strip(const TriangleMesh& mesh, const MeshAdjacency& adjacency, const TriangleStrip& strip,
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
