#include <algorithm>
#include <array>
#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

#include <Eigen/Geometry>

#include "asperity/geometry/mesh_adjacency.h"
#include "asperity/geometry/mesh_measures.h"
#include "asperity/geometry/mesh_normals.h"

namespace asperity {

namespace {

// Sets that are joined one by one; each is known by one of its members.
class Sets {
 public:
  explicit Sets(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0U); }

  std::uint32_t find(std::uint32_t one) {
    while (parent_[one] != one) one = parent_[one] = parent_[parent_[one]];
    return one;
  }
  void join(std::uint32_t a, std::uint32_t b) { parent_[find(a)] = find(b); }

 private:
  std::vector<std::uint32_t> parent_;
};

void measure_box(const TriangleMesh& mesh, MeshMeasures& out) {
  std::vector<bool> used(mesh.vertices_m.size(), false);
  Eigen::AlignedBox3d box;
  for (const Triangle& triangle : mesh.triangles) {
    for (const std::uint32_t v : triangle) {
      if (!used[v]) box.extend(mesh.vertices_m[v]);
      used[v] = true;
    }
  }
  out.vertices = static_cast<std::size_t>(std::count(used.begin(), used.end(), true));
  if (box.isEmpty()) return;
  out.low_m = box.min();
  out.high_m = box.max();
}

void measure_triangles(const TriangleMesh& mesh, MeshMeasures& out) {
  const std::vector<Eigen::Vector3d> normals = facet_normals(mesh);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Triangle& triangle = mesh.triangles[t];
    const Eigen::Vector3d& a_m = mesh.vertices_m[triangle[0]];
    out.area_m2 += 0.5 * (mesh.vertices_m[triangle[1]] - a_m).cross(mesh.vertices_m[triangle[2]] - a_m).norm();
    if (normals[t].isZero(0.0)) ++out.degenerate_triangles;
  }
}

// By the divergence theorem: tetrahedra from the middle of the box, from which rounding is least.
double signed_volume_m3(const TriangleMesh& mesh, const Eigen::Vector3d& from_m) {
  double out = 0.0;
  for (const Triangle& triangle : mesh.triangles) {
    const Eigen::Vector3d a_m = mesh.vertices_m[triangle[0]] - from_m;
    const Eigen::Vector3d b_m = mesh.vertices_m[triangle[1]] - from_m;
    out += a_m.dot(b_m.cross(mesh.vertices_m[triangle[2]] - from_m)) / 6.0;
  }
  return out;
}

// Whether a triangle goes through an edge from its lower vertex to its higher one.
bool goes_up(const Triangle& triangle, const std::array<std::uint32_t, 2>& edge) {
  for (std::size_t k = 0; k < 3; ++k) {
    if (triangle[k] == edge[0] && triangle[(k + 1) % 3] == edge[1]) return true;
  }
  return false;
}

void count_edges(const TriangleMesh& mesh, const MeshAdjacency& adjacency, MeshMeasures& out) {
  out.edges = adjacency.edge_vertices.size();
  for (std::uint32_t e = 0; e < out.edges; ++e) {
    const std::span<const std::uint32_t> triangles = adjacency.triangles_of_edge(e);
    if (triangles.size() == 1) ++out.open_edges;
    if (triangles.size() > 2) ++out.non_manifold_edges;
    if (triangles.size() != 2) continue;
    const std::array<std::uint32_t, 2>& ends = adjacency.edge_vertices[e];
    if (goes_up(mesh.triangles[triangles[0]], ends) == goes_up(mesh.triangles[triangles[1]], ends)) ++out.flipped_edges;
  }
}

void measure_edges(const TriangleMesh& mesh, const MeshAdjacency& adjacency, MeshMeasures& out) {
  std::vector<double> lengths_m;
  lengths_m.reserve(adjacency.edge_vertices.size());
  for (const auto& [low, high] : adjacency.edge_vertices)
    lengths_m.push_back((mesh.vertices_m[high] - mesh.vertices_m[low]).norm());
  if (lengths_m.empty()) return;
  const auto [shortest, longest] = std::minmax_element(lengths_m.begin(), lengths_m.end());
  out.shortest_edge_m = *shortest;
  out.longest_edge_m = *longest;
  const auto middle = lengths_m.begin() + static_cast<std::ptrdiff_t>((lengths_m.size() - 1) / 2);
  std::nth_element(lengths_m.begin(), middle, lengths_m.end());
  out.median_edge_m = *middle;
}

std::size_t count_parts(const TriangleMesh& mesh) {
  Sets sets(mesh.vertices_m.size());
  for (const Triangle& triangle : mesh.triangles) {
    sets.join(triangle[0], triangle[1]);
    sets.join(triangle[1], triangle[2]);
  }
  std::vector<std::uint32_t> roots;
  roots.reserve(mesh.triangles.size());
  for (const Triangle& triangle : mesh.triangles) roots.push_back(sets.find(triangle[0]));
  std::sort(roots.begin(), roots.end());
  return static_cast<std::size_t>(std::unique(roots.begin(), roots.end()) - roots.begin());
}

// Two triangles of a vertex are of one piece there if they share an edge that ends at it.
std::size_t count_non_manifold_vertices(const TriangleMesh& mesh, const MeshAdjacency& adjacency) {
  Sets corners(3 * mesh.triangles.size());
  const auto corner = [&mesh](std::uint32_t t, std::uint32_t vertex) {
    std::uint32_t k = 0;
    while (mesh.triangles[t][k] != vertex) ++k;
    return 3 * t + k;
  };
  for (std::uint32_t e = 0; e < adjacency.edge_vertices.size(); ++e) {
    const std::span<const std::uint32_t> triangles = adjacency.triangles_of_edge(e);
    for (const std::uint32_t t : triangles.subspan(1)) {
      for (const std::uint32_t v : adjacency.edge_vertices[e]) corners.join(corner(triangles[0], v), corner(t, v));
    }
  }
  std::size_t out = 0;
  for (std::uint32_t v = 0; v < mesh.vertices_m.size(); ++v) {
    const std::span<const std::uint32_t> around = adjacency.triangles_of_vertex(v);
    if (around.empty()) continue;
    const std::uint32_t first = corners.find(corner(around[0], v));
    if (std::any_of(around.begin(), around.end(), [&](std::uint32_t t) { return corners.find(corner(t, v)) != first; }))
      ++out;
  }
  return out;
}

}  // namespace

MeshMeasures measure_mesh(const TriangleMesh& given, const Observer& observer) {
  constexpr const char* kStage = "measuring";
  observer.update(kStage, 0.0);
  const TriangleMesh mesh = weld_vertices(given);
  observer.update(kStage, 0.2);
  const MeshAdjacency adjacency = make_adjacency(mesh);
  observer.update(kStage, 0.4);
  MeshMeasures out;
  out.triangles = mesh.triangles.size();
  measure_box(mesh, out);
  measure_triangles(mesh, out);
  observer.update(kStage, 0.5);
  count_edges(mesh, adjacency, out);
  observer.update(kStage, 0.6);
  measure_edges(mesh, adjacency, out);
  observer.update(kStage, 0.7);
  out.parts = count_parts(mesh);
  observer.update(kStage, 0.8);
  out.non_manifold_vertices = count_non_manifold_vertices(mesh, adjacency);
  observer.update(kStage, 1.0);
  if (out.closed() && out.edges > 0 && out.flipped_edges == 0 && out.non_manifold_edges == 0)
    out.volume_m3 = signed_volume_m3(mesh, 0.5 * (out.low_m + out.high_m));
  return out;
}

}  // namespace asperity
