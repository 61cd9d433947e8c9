#include "asperity/geometry/connected_point.h"

#include <algorithm>

#include <Eigen/Geometry>

namespace asperity {

using Eigen::Vector3d;

Vector3d weights_of(const TriangleMesh& mesh, std::uint32_t triangle, const Vector3d& p) {
  const auto& [ia, ib, ic] = mesh.triangles[triangle];
  const Vector3d& a = mesh.vertices_m[ia];
  const Vector3d ab = mesh.vertices_m[ib] - a;
  const Vector3d ac = mesh.vertices_m[ic] - a;
  const Vector3d normal = ab.cross(ac);
  const double area = normal.squaredNorm();
  Vector3d weight = Vector3d::UnitX();
  if (area > 0.0) {
    weight[1] = (p - a).cross(ac).dot(normal) / area;
    weight[2] = ab.cross(p - a).dot(normal) / area;
    weight[0] = 1.0 - weight[1] - weight[2];
  }
  weight = weight.cwiseMax(0.0);
  return weight / weight.sum();
}

MeshPoint connected_point(const TriangleMesh& mesh, const MeshAdjacency& adjacency, std::uint32_t triangle,
                          const Vector3d& p) {
  if (adjacency.edge_of_triangle[triangle][0] != MeshAdjacency::kNone) return {triangle, weights_of(mesh, triangle, p)};
  const Triangle& tri = mesh.triangles[triangle];
  const std::uint32_t other = tri[1] != tri[0] ? tri[1] : tri[2];
  const auto around = adjacency.triangles_of_vertex(tri[0]);
  for (const std::uint32_t t : around) {
    const Triangle& candidate = mesh.triangles[t];
    if (std::find(candidate.begin(), candidate.end(), other) != candidate.end()) return {t, weights_of(mesh, t, p)};
  }
  const std::uint32_t found = around.empty() ? triangle : around.front();
  return {found, weights_of(mesh, found, p)};
}

}  // namespace asperity
