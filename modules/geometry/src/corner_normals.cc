#include "asperity/geometry/corner_normals.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>

#include "asperity/geometry/mesh_normals.h"

namespace asperity {

namespace {

std::size_t corner_of(const Triangle& triangle, std::uint32_t vertex) {
  return triangle[0] == vertex ? 0 : triangle[1] == vertex ? 1 : 2;
}

// The angle of a facet at one of its corners, rad.
double angle_at(const TriangleMesh& mesh, const Triangle& triangle, std::size_t corner) {
  const Eigen::Vector3d& at = mesh.vertices_m[triangle[corner]];
  const Eigen::Vector3d a = mesh.vertices_m[triangle[(corner + 1) % 3]] - at;
  const Eigen::Vector3d b = mesh.vertices_m[triangle[(corner + 2) % 3]] - at;
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

// Whether the surface goes on smoothly over edge `edge` from one of its triangles to the other. A degenerate
// triangle has no direction that could bend.
bool is_smooth(const std::vector<Eigen::Vector3d>& facets, std::uint32_t a, std::uint32_t b, double cosine) {
  if (facets[a].isZero(0.0) || facets[b].isZero(0.0)) return true;
  return facets[a].dot(facets[b]) >= cosine;
}

}  // namespace

std::vector<std::array<Eigen::Vector3d, 3>> corner_normals(const TriangleMesh& mesh, const MeshAdjacency& adjacency,
                                                           double crease_rad) {
  const std::vector<Eigen::Vector3d> facets = facet_normals(mesh);
  const double cosine = std::cos(crease_rad);
  constexpr double kRounding = 64.0 * std::numeric_limits<double>::epsilon();
  std::vector<std::array<Eigen::Vector3d, 3>> out(mesh.triangles.size());
  std::vector<std::uint32_t> group;  // of each triangle about the vertex: the least position joined to it
  std::vector<Eigen::Vector3d> sum;
  for (std::uint32_t vertex = 0; vertex < mesh.vertices_m.size(); ++vertex) {
    const auto around = adjacency.triangles_of_vertex(vertex);
    const std::size_t count = around.size();
    group.resize(count);
    for (std::size_t i = 0; i < count; ++i) group[i] = static_cast<std::uint32_t>(i);
    const auto root = [&](std::uint32_t i) {
      while (group[i] != i) i = group[i] = group[group[i]];
      return i;
    };
    for (std::size_t i = 0; i < count; ++i) {
      for (const std::uint32_t edge : adjacency.edge_of_triangle[around[i]]) {
        const auto& ends = adjacency.edge_vertices[edge];
        if (ends[0] != vertex && ends[1] != vertex) continue;
        const auto sharing = adjacency.triangles_of_edge(edge);
        if (sharing.size() != 2) continue;
        const std::uint32_t other = sharing[0] == around[i] ? sharing[1] : sharing[0];
        if (other < around[i] || !is_smooth(facets, around[i], other, cosine)) continue;
        const auto j = std::lower_bound(around.begin(), around.end(), other) - around.begin();
        const std::uint32_t a = root(static_cast<std::uint32_t>(i)), b = root(static_cast<std::uint32_t>(j));
        group[std::max(a, b)] = std::min(a, b);
      }
    }
    sum.assign(count, Eigen::Vector3d::Zero());
    for (std::size_t i = 0; i < count; ++i) {
      const Triangle& triangle = mesh.triangles[around[i]];
      sum[root(static_cast<std::uint32_t>(i))] +=
          angle_at(mesh, triangle, corner_of(triangle, vertex)) * facets[around[i]];
    }
    for (std::size_t i = 0; i < count; ++i) {
      const Eigen::Vector3d& total = sum[root(static_cast<std::uint32_t>(i))];
      const Triangle& triangle = mesh.triangles[around[i]];
      const Eigen::Vector3d normal = total.norm() > kRounding ? Eigen::Vector3d(total.normalized()) : facets[around[i]];
      for (std::size_t corner = 0; corner < 3; ++corner) {
        if (triangle[corner] == vertex) out[around[i]][corner] = normal;
      }
    }
  }
  return out;
}

}  // namespace asperity
