#pragma once

#include <cstddef>
#include <optional>

#include <Eigen/Core>

#include "asperity/base/progress.h"
#include "asperity/geometry/triangle_mesh.h"

namespace asperity {

// What a mesh is, in numbers. Vertices at exactly the same position count as one (weld_vertices), so that files that
// repeat a vertex for each triangle (STL) or along a seam are measured as the surface that they show.
struct MeshMeasures {
  std::size_t triangles = 0;
  std::size_t vertices = 0;                         // different positions that a triangle uses
  Eigen::Vector3d low_m = Eigen::Vector3d::Zero();  // corners of the box around the triangles, mesh frame
  Eigen::Vector3d high_m = Eigen::Vector3d::Zero();
  double area_m2 = 0.0;
  // Enclosed volume, positive where the triangles face outwards; none unless the mesh is closed, oriented and without
  // edges of more than two triangles. Inner surfaces that face inwards (cavities) are taken off.
  std::optional<double> volume_m3;
  std::size_t parts = 0;  // pieces that share no edge and no vertex
  std::size_t edges = 0;
  double shortest_edge_m = 0.0;
  double median_edge_m = 0.0;  // the lower one of an even count
  double longest_edge_m = 0.0;
  std::size_t open_edges = 0;             // of one triangle
  std::size_t non_manifold_edges = 0;     // of more than two triangles
  std::size_t non_manifold_vertices = 0;  // at which pieces meet that share no edge there
  std::size_t flipped_edges = 0;          // of two triangles that face opposite sides
  std::size_t degenerate_triangles = 0;   // without an area: corners that coincide or are on a line

  bool closed() const { return triangles > 0 && open_edges == 0; }
};

// Throws Error for an index out of range, Cancelled. Of a mesh without triangles all counts are zero. Scale-free: a
// mesh scaled by a power of two has the same counts.
MeshMeasures measure_mesh(const TriangleMesh& mesh, const Observer& observer = {});

}  // namespace asperity
