#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

#include "asperity/geometry/triangle_mesh.h"

namespace asperity {

enum class PolygonShape {
  kSimple,      // the triangles tile the polygon
  kDegenerate,  // no area: the triangles are a fan
  kCrossing     // the outline crosses or touches itself: the triangles may overlap
};

// Cuts the polygon through `points` (three or more, in order) into points.size() - 2 triangles of the same
// orientation, appended to `triangles` as indices of `points`.
// Ears are cut in the polygon's plane: its normal n = Σ p_i × p_{i+1} (Newell) is that of the plane of
// largest projected area, and the axis along which |n| is largest is dropped, which keeps every
// orientation and rounds nothing. A corner is an ear if it is convex and its triangle holds no other
// corner. Signs only, no tolerance: the polygon scaled by a power of two is cut alike. A convex polygon
// is a fan from its first corner. Takes time of the square of the number of corners.
PolygonShape triangulate_polygon(std::span<const Eigen::Vector3d> points, std::vector<Triangle>& triangles);

}  // namespace asperity
