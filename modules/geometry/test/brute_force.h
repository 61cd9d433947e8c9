#pragma once

#include <algorithm>
#include <array>
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

__extension__ using Quad = __float128;

// The distance from the plane where p projects inside the triangle, else infinity.
template <class T>
long double inside_distance(const Vector3l& a, const Vector3l& b, const Vector3l& c, const Vector3l& p) {
  using Vector = std::array<T, 3>;
  const auto minus = [](const Vector3l& x, const Vector3l& y) {
    return Vector{T(x[0]) - T(y[0]), T(x[1]) - T(y[1]), T(x[2]) - T(y[2])};
  };
  const auto cross = [](const Vector& x, const Vector& y) {
    return Vector{x[1] * y[2] - x[2] * y[1], x[2] * y[0] - x[0] * y[2], x[0] * y[1] - x[1] * y[0]};
  };
  const auto dot = [](const Vector& x, const Vector& y) { return x[0] * y[0] + x[1] * y[1] + x[2] * y[2]; };
  const Vector n = cross(minus(b, a), minus(c, a));
  if (dot(n, n) == 0 || dot(n, cross(minus(b, a), minus(p, a))) < 0 || dot(n, cross(minus(c, b), minus(p, b))) < 0 ||
      dot(n, cross(minus(a, c), minus(p, c))) < 0)
    return std::numeric_limits<long double>::infinity();
  const T height = dot(n, minus(p, a));
  return std::sqrt(static_cast<long double>(height * height / dot(n, n)));
}

// The distance of p from a triangle: that of the plane where p projects inside, or that of the edges. In 80 bits, and
// in 113 where the triangle is so thin that its normal in 80 bits would not do.
inline long double triangle_distance(const Vector3l& a, const Vector3l& b, const Vector3l& c, const Vector3l& p) {
  const long double edges = std::min({segment_distance(a, b, p), segment_distance(b, c, p), segment_distance(c, a, p)});
  const long double length2 = std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()});
  const long double area2 = (b - a).cross(c - a).norm();
  if (area2 > 1e-5L * length2) return std::min(edges, inside_distance<long double>(a, b, c, p));
  // Thinner than anything that a double of the distance could show.
  if (area2 < 1e-17L * length2) return edges;
  return std::min(edges, inside_distance<Quad>(a, b, c, p));
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
