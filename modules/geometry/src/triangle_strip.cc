#include "asperity/geometry/triangle_strip.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <queue>
#include <string>
#include <unordered_map>

#include "asperity/base/error.h"

namespace asperity {
namespace {

using Eigen::Vector3d;

constexpr std::uint32_t kPointsPerEdge = 3;
constexpr std::uint32_t kNoNode = MeshAdjacency::kNone;

Vector3d edge_point(const TriangleMesh& mesh, const MeshAdjacency& adjacency, std::uint32_t node) {
  const auto [a, b] = adjacency.edge_vertices[node / kPointsPerEdge];
  const double u = static_cast<double>(node % kPointsPerEdge + 1) / (kPointsPerEdge + 1);
  return (1.0 - u) * mesh.vertices_m[a] + u * mesh.vertices_m[b];
}

}  // namespace

TriangleStrip find_strip(const TriangleMesh& mesh, const MeshAdjacency& adjacency, const MeshPoint& from,
                         const MeshPoint& to) {
  if (from.triangle == to.triangle) return {{from.triangle}, {}};
  struct Reached {
    double length_m = std::numeric_limits<double>::infinity();
    std::uint32_t before = kNoNode;
    std::uint32_t through = kNoNode;  // the triangle by which the node was reached
    bool done = false;
  };
  std::unordered_map<std::uint32_t, Reached> nodes;
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
  const auto reach_edges_of = [&](std::uint32_t triangle, std::uint32_t last, const Vector3d& p, double so_far_m) {
    for (const std::uint32_t edge : adjacency.edge_of_triangle[triangle]) {
      if (edge == kNoNode || (last != kNoNode && edge == last / kPointsPerEdge)) continue;
      for (std::uint32_t node = edge * kPointsPerEdge; node < (edge + 1) * kPointsPerEdge; ++node) {
        const Vector3d q = edge_point(mesh, adjacency, node);
        const double reached_m = so_far_m + (q - p).norm();
        Reached& r = nodes[node];
        if (!(reached_m < r.length_m)) continue;
        r.length_m = reached_m;
        r.before = last;
        r.through = triangle;
        queue.push({reached_m + (goal - q).norm(), node});
      }
    }
  };
  reach_edges_of(from.triangle, kNoNode, start, 0.0);
  double best_m = std::numeric_limits<double>::infinity();
  std::uint32_t last = kNoNode;
  while (!queue.empty() && queue.top().least_m < best_m) {
    const std::uint32_t node = queue.top().node;
    queue.pop();
    if (nodes[node].done) continue;
    nodes[node].done = true;
    const double so_far_m = nodes[node].length_m;
    const std::uint32_t came_through = nodes[node].through;
    const Vector3d p = edge_point(mesh, adjacency, node);
    for (const std::uint32_t triangle : adjacency.triangles_of_edge(node / kPointsPerEdge)) {
      if (triangle == to.triangle && so_far_m + (goal - p).norm() < best_m) {
        best_m = so_far_m + (goal - p).norm();
        last = node;
      }
      if (triangle != came_through) reach_edges_of(triangle, node, p, so_far_m);
    }
  }
  if (last == kNoNode) {
    throw Error("mesh: no triangles connect triangle " + std::to_string(from.triangle) + " with triangle " +
                std::to_string(to.triangle));
  }
  TriangleStrip strip{{to.triangle}, {}};
  for (std::uint32_t node = last; node != kNoNode; node = nodes[node].before) {
    strip.edges.push_back(node / kPointsPerEdge);
    strip.faces.push_back(nodes[node].through);
  }
  std::reverse(strip.edges.begin(), strip.edges.end());
  std::reverse(strip.faces.begin(), strip.faces.end());
  return strip;
}

}  // namespace asperity
