#include "strip_funnel.h"

#include <algorithm>

#include "asperity/geometry/flat_triangle.h"

namespace asperity {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

double cross(const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

}  // namespace

UnfoldedStrip unfold_strip(const TriangleMesh& mesh, const MeshAdjacency& adjacency, const TriangleStrip& strip,
                           const Vector3d& from, const Vector3d& to) {
  const auto vertex = [&mesh](std::uint32_t v) -> const Vector3d& { return mesh.vertices_m[v]; };
  UnfoldedStrip flat;
  flat.portals.reserve(strip.edges.size());
  for (std::size_t i = 0; i < strip.edges.size(); ++i) {
    if (i == 0) {
      // Leaving a triangle that turns a → b → c over its edge a → b, b is to the left.
      const auto& edges = adjacency.edge_of_triangle[strip.faces[0]];
      const auto e = static_cast<std::size_t>(std::find(edges.begin(), edges.end(), strip.edges[0]) - edges.begin());
      const std::uint32_t right = mesh.triangles[strip.faces[0]][e];
      const std::uint32_t left = mesh.triangles[strip.faces[0]][(e + 1) % 3];
      flat.portals.push_back({{0.0, (vertex(left) - vertex(right)).norm()}, Vector2d::Zero(), left, right});
      continue;
    }
    Portal next = flat.portals.back();
    const auto [a, b] = adjacency.edge_vertices[strip.edges[i]];
    const bool keeps_left = a == next.left_vertex || b == next.left_vertex;
    const std::uint32_t kept = keeps_left ? next.left_vertex : next.right_vertex;
    const std::uint32_t apex = a == kept ? b : a;
    const Vector2d place =
        place_beside(vertex(apex), vertex(next.right_vertex), vertex(next.left_vertex), next.right, next.left, -1.0);
    (keeps_left ? next.right : next.left) = place;
    (keeps_left ? next.right_vertex : next.left_vertex) = apex;
    flat.portals.push_back(next);
  }
  if (flat.portals.empty()) {
    flat.from = Vector2d::Zero();
    flat.to = Vector2d((to - from).norm(), 0.0);
    return flat;
  }
  const Portal& first = flat.portals.front();
  const Portal& final = flat.portals.back();
  flat.from = place_beside(from, vertex(first.right_vertex), vertex(first.left_vertex), first.right, first.left, 1.0);
  flat.to = place_beside(to, vertex(final.right_vertex), vertex(final.left_vertex), final.right, final.left, -1.0);
  return flat;
}

std::vector<Bend> shortest_bends(const UnfoldedStrip& strip) {
  std::vector<Bend> bends;
  const std::size_t count = strip.portals.size();
  const auto left_of = [&](std::size_t i) { return i < count ? strip.portals[i].left : strip.to; };
  const auto right_of = [&](std::size_t i) { return i < count ? strip.portals[i].right : strip.to; };
  Vector2d apex = strip.from;
  Vector2d left = apex;
  Vector2d right = apex;
  std::size_t left_at = 0;
  std::size_t right_at = 0;
  for (std::size_t i = 0; i <= count; ++i) {
    const auto bend = [&](std::size_t at, bool is_left) {
      bends.push_back({at, is_left});
      apex = left = right = is_left ? left_of(at) : right_of(at);
      left_at = right_at = i = at;
    };
    const Vector2d l = left_of(i) - apex;
    const Vector2d r = right_of(i) - apex;
    // Of two points in line with the last bend, within rounding, the path can only bend round the nearer.
    const auto crosses = [](double over, const Vector2d& p, const Vector2d& other) {
      constexpr double kInLine_rad = 1e-12;
      const double slack = kInLine_rad * p.norm() * other.norm();
      return over > slack || (over >= -slack && p.dot(other) > 0.0 && p.squaredNorm() >= other.squaredNorm());
    };
    if (cross(right - apex, r) >= 0.0) {
      if (left != apex && right != apex && crosses(cross(left - apex, r), r, left - apex)) {
        if (left_at == count) break;
        bend(left_at, true);
        continue;
      }
      right = right_of(i);
      right_at = i;
    }
    if (cross(left - apex, l) <= 0.0) {
      if (left != apex && right != apex && crosses(-cross(right - apex, l), l, right - apex)) {
        if (right_at == count) break;
        bend(right_at, false);
        continue;
      }
      left = left_of(i);
      left_at = i;
    }
  }
  return bends;
}

}  // namespace asperity
