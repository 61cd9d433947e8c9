#pragma once

#include <array>
#include <cstdint>

#include <Eigen/Core>

#include "asperity/geometry/triangle_mesh.h"

namespace asperity {

// Where the corners of a triangle lie in a plane into which a surface is unfolded; lengths are kept.
struct FlatTriangle {
  std::array<Eigen::Vector2d, 3> corner{Eigen::Vector2d::Zero(), Eigen::Vector2d::Zero(), Eigen::Vector2d::Zero()};

  Eigen::Vector2d at(const Eigen::Vector3d& barycentric) const {
    return barycentric[0] * corner[0] + barycentric[1] * corner[1] + barycentric[2] * corner[2];
  }
  // The weights of a point of the plane; not finite for a triangle without area.
  Eigen::Vector3d barycentric(const Eigen::Vector2d& p) const;
};

// The place of `p` beside the line from `a` to `b`, whose places are given: `side` is 1 to its left and -1
// to its right. Where a and b are one point, any place at the right distance.
Eigen::Vector2d place_beside(const Eigen::Vector3d& p, const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                             const Eigen::Vector2d& flat_a, const Eigen::Vector2d& flat_b, double side);

// A triangle with its first corner at the origin and its second on the x axis, seen from outside.
FlatTriangle flatten_triangle(const TriangleMesh& mesh, std::uint32_t triangle);

// The triangle `next` turned about the edge that it shares with `triangle` into the plane of `flat`, beyond
// the edge. `edge` holds the edge's vertices.
FlatTriangle flatten_over(const TriangleMesh& mesh, std::uint32_t triangle, const FlatTriangle& flat,
                          const std::array<std::uint32_t, 2>& edge, std::uint32_t next);

}  // namespace asperity
