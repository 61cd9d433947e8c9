#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "asperity/geometry/triangle_mesh.h"

namespace asperity {

// Which triangles of a mesh meet at its edges and vertices. Edge e of a triangle runs from its corner e to
// its corner (e + 1) % 3. An edge has one triangle at a border, two inside a surface, more where the mesh
// is non-manifold. A triangle that names a vertex twice takes no part: its edges are kNone.
struct MeshAdjacency {
  static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

  std::vector<std::array<std::uint32_t, 3>> edge_of_triangle;  // [triangle][e]: index of its edge e
  std::vector<std::array<std::uint32_t, 2>> edge_vertices;     // [edge]: its ends, the lower index first
  std::vector<std::uint32_t> edge_first;                       // [edge]: where its triangles begin; one more at the end
  std::vector<std::uint32_t> edge_triangles;                   // ascending within an edge
  std::vector<std::uint32_t> vertex_first;      // [vertex]: where its triangles begin; one more at the end
  std::vector<std::uint32_t> vertex_triangles;  // ascending within a vertex

  std::span<const std::uint32_t> triangles_of_edge(std::uint32_t edge) const {
    return {edge_triangles.data() + edge_first[edge], edge_triangles.data() + edge_first[edge + 1]};
  }
  std::span<const std::uint32_t> triangles_of_vertex(std::uint32_t vertex) const {
    return {vertex_triangles.data() + vertex_first[vertex], vertex_triangles.data() + vertex_first[vertex + 1]};
  }
};

// Vertices are joined by index only: see weld_vertices. Throws Error for an index out of range or more than
// 2^32 / 3 triangles.
MeshAdjacency make_adjacency(const TriangleMesh& mesh);

// The same triangles in the same order, with vertices at exactly the same position made one (the one of
// lowest index; the others remain, unused): in files that repeat a vertex for each triangle (STL) or
// along a seam, the surface becomes one. Throws Error for an index out of range.
TriangleMesh weld_vertices(const TriangleMesh& mesh);

}  // namespace asperity
