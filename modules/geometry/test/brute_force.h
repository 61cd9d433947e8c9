#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>

#include "asperity/geometry/triangle_mesh.h"

namespace asperity::test {

using Vector3l = Eigen::Matrix<long double, 3, 1>;

inline long double segment_distance(const Vector3l& a, const Vector3l& b, const Vector3l& p) {
  const Vector3l e = b - a;
  const long double ee = e.squaredNorm();
  const long double t = ee > 0.0L ? std::clamp((p - a).dot(e) / ee, 0.0L, 1.0L) : 0.0L;
  return (p - a - t * e).norm();
}

// The distance of p from a triangle in 80 bits: the plane's where p projects inside, or that of the edges.
inline long double triangle_distance(const Vector3l& a, const Vector3l& b, const Vector3l& c, const Vector3l& p) {
  long double best = std::min({segment_distance(a, b, p), segment_distance(b, c, p), segment_distance(c, a, p)});
  const Vector3l n = (b - a).cross(c - a);
  const long double size = std::max((b - a).norm() * (c - a).norm(), (b - a).norm() * (c - b).norm());
  if (n.norm() > 1e-15L * size && n.dot((b - a).cross(p - a)) >= 0 && n.dot((c - b).cross(p - b)) >= 0 &&
      n.dot((a - c).cross(p - c)) >= 0)
    best = std::min(best, std::abs(n.dot(p - a)) / n.norm());
  return best;
}

inline long double triangle_distance(const TriangleMesh& mesh, std::size_t triangle, const Eigen::Vector3d& p) {
  const auto v = [&](std::size_t k) -> Vector3l {
    return mesh.vertices_m[mesh.triangles[triangle][k]].cast<long double>();
  };
  return triangle_distance(v(0), v(1), v(2), p.cast<long double>());
}

// The distance of p from the mesh, from every triangle in turn.
inline long double mesh_distance(const TriangleMesh& mesh, const Eigen::Vector3d& p) {
  long double best = std::numeric_limits<long double>::infinity();
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) best = std::min(best, triangle_distance(mesh, i, p));
  return best;
}

}  // namespace asperity::test
