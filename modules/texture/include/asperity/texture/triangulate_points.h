#pragma once

#include <array>
#include <span>
#include <vector>

namespace asperity {

using PlanePoint = std::array<double, 2>;

// Delaunay's triangulation of points of the plane, counter-clockwise index triples: the points are sorted, joined to
// the growing hull one by one, and edges are flipped until each circumcircle is empty (Lawson 1977).
// The points are rounded to 2⁻²⁰ of the larger extent, and decided about in integers: the result is exact for the
// rounded points, and the same at any scale. Of points that coincide so, the first is used. Empty if all lie on a line.
// Throws Error for a coordinate that is not finite or more than 4096 points.
std::vector<std::array<int, 3>> triangulate_points(std::span<const PlanePoint> points);

// The edges that belong to one triangle only; the points on the shortest chain along their line instead, if there
// is not a triangle.
std::vector<std::array<int, 2>> border_edges(std::span<const PlanePoint> points,
                                             std::span<const std::array<int, 3>> triangles);

}  // namespace asperity
