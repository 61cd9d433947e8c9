#include "asperity/geometry/flat_triangle.h"

#include <Eigen/Geometry>

namespace asperity {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

double cross(const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

std::size_t corner_at(const Triangle& tri, std::uint32_t vertex) {
  return tri[0] == vertex ? 0 : tri[1] == vertex ? 1 : 2;
}

std::size_t apex_of(const Triangle& tri, const std::array<std::uint32_t, 2>& edge) {
  for (std::size_t i = 0; i < 2; ++i) {
    if (tri[i] != edge[0] && tri[i] != edge[1]) return i;
  }
  return 2;
}

}  // namespace

Vector3d FlatTriangle::barycentric(const Vector2d& p) const {
  const double area = cross(corner[1] - corner[0], corner[2] - corner[0]);
  const double b = cross(p - corner[0], corner[2] - corner[0]) / area;
  const double c = cross(corner[1] - corner[0], p - corner[0]) / area;
  return {1.0 - b - c, b, c};
}

Vector2d place_beside(const Vector3d& p, const Vector3d& a, const Vector3d& b, const Vector2d& flat_a,
                      const Vector2d& flat_b, double side) {
  const Vector3d edge = b - a;
  const Vector2d flat = flat_b - flat_a;
  const double length = edge.norm();
  const double flat_length = flat.norm();
  const Vector3d out = p - a;
  if (!(length > 0.0) || !(flat_length > 0.0)) return flat_a + side * Vector2d(out.norm(), 0.0);
  const Vector3d along = edge / length;
  const Vector2d flat_along = flat / flat_length;
  return flat_a + out.dot(along) * flat_along +
         side * along.cross(out).norm() * Vector2d(-flat_along.y(), flat_along.x());
}

FlatTriangle flatten_triangle(const TriangleMesh& mesh, std::uint32_t triangle) {
  const auto& [a, b, c] = mesh.triangles[triangle];
  FlatTriangle out;
  out.corner[1] = Vector2d((mesh.vertices_m[b] - mesh.vertices_m[a]).norm(), 0.0);
  out.corner[2] =
      place_beside(mesh.vertices_m[c], mesh.vertices_m[a], mesh.vertices_m[b], out.corner[0], out.corner[1], 1.0);
  return out;
}

FlatTriangle flatten_over(const TriangleMesh& mesh, std::uint32_t triangle, const FlatTriangle& flat,
                          const std::array<std::uint32_t, 2>& edge, std::uint32_t next) {
  const Triangle& old_tri = mesh.triangles[triangle];
  const Triangle& new_tri = mesh.triangles[next];
  const Vector2d& a = flat.corner[corner_at(old_tri, edge[0])];
  const Vector2d& b = flat.corner[corner_at(old_tri, edge[1])];
  const Vector2d& old_apex = flat.corner[apex_of(old_tri, edge)];
  const double side = cross(b - a, old_apex - a) > 0.0 ? -1.0 : 1.0;
  const std::size_t apex = apex_of(new_tri, edge);
  FlatTriangle out;
  out.corner[corner_at(new_tri, edge[0])] = a;
  out.corner[corner_at(new_tri, edge[1])] = b;
  out.corner[apex] =
      place_beside(mesh.vertices_m[new_tri[apex]], mesh.vertices_m[edge[0]], mesh.vertices_m[edge[1]], a, b, side);
  return out;
}

}  // namespace asperity
