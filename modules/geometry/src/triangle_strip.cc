#include "triangle_strip.h"

#include <algorithm>
#include <cmath>
#include <queue>

#include <Eigen/Geometry>

#include "asperity/base/error.h"

namespace asperity {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr std::uint32_t kPointsPerEdge = 3;
constexpr std::uint32_t kNone = MeshAdjacency::kNone;

Vector3d edge_point(const TriangleMesh& mesh, const MeshAdjacency& adjacency, std::uint32_t node) {
  const auto [a, b] = adjacency.edge_vertices[node / kPointsPerEdge];
  const double u = static_cast<double>(node % kPointsPerEdge + 1) / (kPointsPerEdge + 1);
  return (1.0 - u) * mesh.vertices_m[a] + u * mesh.vertices_m[b];
}

double cross(const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

// The place of `p` beside the edge from `right` to `left`: `side` is 1 ahead of the edge and -1 behind it.
Vector2d lay_flat(const Vector3d& p, const Vector3d& right, const Vector3d& left, const Vector2d& flat_right,
                  const Vector2d& flat_left, double side) {
  const Vector3d edge = left - right;
  const double length = edge.norm();
  const Vector3d out = p - right;
  const Vector2d flat = flat_left - flat_right;
  if (!(length > 0.0) || !(flat.norm() > 0.0)) return flat_right + side * Vector2d(out.norm(), 0.0);
  const Vector3d along = edge / length;
  const Vector2d flat_along = flat.normalized();
  return flat_right + out.dot(along) * flat_along +
         side * along.cross(out).norm() * Vector2d(flat_along.y(), -flat_along.x());
}

}  // namespace

TriangleStrip first_strip(const TriangleMesh& mesh, const MeshAdjacency& adjacency, const MeshPoint& from,
                          const MeshPoint& to) {
  if (from.triangle == to.triangle) return {{from.triangle}, {}};
  const std::size_t nodes = adjacency.edge_vertices.size() * kPointsPerEdge;
  std::vector<double> length_m(nodes, std::numeric_limits<double>::infinity());
  std::vector<std::uint32_t> before(nodes, kNone);
  std::vector<std::uint32_t> through(nodes, kNone);  // the triangle by which a node was reached
  const Vector3d start = position_m(mesh, from);
  const Vector3d goal = position_m(mesh, to);

  struct Entry {
    double least_m;  // no path over the node is shorter
    std::uint32_t node;
    bool operator>(const Entry& other) const {
      return least_m != other.least_m ? least_m > other.least_m : node > other.node;
    }
  };
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  std::vector<bool> done(nodes, false);
  const auto reach_edges_of = [&](std::uint32_t triangle, std::uint32_t last, const Vector3d& p, double so_far_m) {
    for (const std::uint32_t edge : adjacency.edge_of_triangle[triangle]) {
      if (edge == kNone || (last != kNone && edge == last / kPointsPerEdge)) continue;
      for (std::uint32_t node = edge * kPointsPerEdge; node < (edge + 1) * kPointsPerEdge; ++node) {
        const Vector3d q = edge_point(mesh, adjacency, node);
        const double reached_m = so_far_m + (q - p).norm();
        if (!(reached_m < length_m[node])) continue;
        length_m[node] = reached_m;
        before[node] = last;
        through[node] = triangle;
        queue.push({reached_m + (goal - q).norm(), node});
      }
    }
  };
  reach_edges_of(from.triangle, kNone, start, 0.0);
  double best_m = std::numeric_limits<double>::infinity();
  std::uint32_t last = kNone;
  while (!queue.empty() && queue.top().least_m < best_m) {
    const std::uint32_t node = queue.top().node;
    queue.pop();
    if (done[node]) continue;
    done[node] = true;
    const Vector3d p = edge_point(mesh, adjacency, node);
    for (const std::uint32_t triangle : adjacency.triangles_of_edge(node / kPointsPerEdge)) {
      if (triangle == to.triangle && length_m[node] + (goal - p).norm() < best_m) {
        best_m = length_m[node] + (goal - p).norm();
        last = node;
      }
      if (triangle != through[node]) reach_edges_of(triangle, node, p, length_m[node]);
    }
  }
  if (last == kNone) {
    throw Error("mesh: no triangles connect triangle " + std::to_string(from.triangle) + " with triangle " +
                std::to_string(to.triangle));
  }
  TriangleStrip strip{{to.triangle}, {}};
  for (std::uint32_t node = last; node != kNone; node = before[node]) {
    strip.edges.push_back(node / kPointsPerEdge);
    strip.faces.push_back(through[node]);
  }
  std::reverse(strip.edges.begin(), strip.edges.end());
  std::reverse(strip.faces.begin(), strip.faces.end());
  return strip;
}

UnfoldedStrip unfold(const TriangleMesh& mesh, const MeshAdjacency& adjacency, const TriangleStrip& strip,
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
        lay_flat(vertex(apex), vertex(next.right_vertex), vertex(next.left_vertex), next.right, next.left, 1.0);
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
  flat.from = lay_flat(from, vertex(first.right_vertex), vertex(first.left_vertex), first.right, first.left, -1.0);
  flat.to = lay_flat(to, vertex(final.right_vertex), vertex(final.left_vertex), final.right, final.left, 1.0);
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
    // Of two points in line with the last bend the path can only bend round the nearer.
    const auto crosses = [](double over, const Vector2d& p, const Vector2d& other) {
      return over > 0.0 || (over == 0.0 && p.squaredNorm() >= other.squaredNorm());
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
