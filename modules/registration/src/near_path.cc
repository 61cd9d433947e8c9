#include "near_path.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <queue>
#include <utility>

#include "asperity/geometry/flat_triangle.h"

namespace asperity {

using Eigen::Vector2d;

std::vector<EdgeDistance> edge_distances(const TriangleMesh& mesh, const MeshAdjacency& adjacency,
                                         std::span<const PathPiece> pieces, const std::vector<bool>& within,
                                         double limit_m) {
  std::vector<EdgeDistance> out(mesh.vertices_m.size());
  using Entry = std::pair<double, std::uint32_t>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  const auto reach = [&](std::uint32_t vertex, const EdgeDistance& by) {
    if (by.distance_m >= out[vertex].distance_m || by.distance_m > limit_m) return;
    out[vertex] = by;
    queue.push({by.distance_m, vertex});
  };
  for (const PathPiece& piece : pieces) {
    const FlatTriangle flat = flatten_triangle(mesh, piece.triangle);
    const Vector2d start = flat.at(piece.from);
    const Vector2d along = flat.at(piece.to) - start;
    const double square = along.squaredNorm();
    for (std::size_t k = 0; k < 3; ++k) {
      const Vector2d out_of_start = flat.corner[k] - start;
      const double u = square > 0.0 ? std::clamp(out_of_start.dot(along) / square, 0.0, 1.0) : 0.0;
      const double left = along.x() * out_of_start.y() - along.y() * out_of_start.x();
      reach(mesh.triangles[piece.triangle][k],
            {(out_of_start - u * along).norm(), piece.from_s_m + u * (piece.to_s_m - piece.from_s_m),
             left > 0.0 ? -1.0 : 1.0});
    }
  }
  while (!queue.empty()) {
    const auto [distance_m, vertex] = queue.top();
    queue.pop();
    if (distance_m > out[vertex].distance_m) continue;
    for (const std::uint32_t triangle : adjacency.triangles_of_vertex(vertex)) {
      if (!within.empty() && !within[triangle]) continue;
      for (const std::uint32_t other : mesh.triangles[triangle]) {
        if (other == vertex) continue;
        EdgeDistance by = out[vertex];
        by.distance_m += (mesh.vertices_m[other] - mesh.vertices_m[vertex]).norm();
        reach(other, by);
      }
    }
  }
  return out;
}

void grow_marked(const TriangleMesh& mesh, const MeshAdjacency& adjacency, int rings, std::vector<bool>& marked) {
  std::vector<std::uint32_t> front;
  for (std::uint32_t t = 0; t < marked.size(); ++t) {
    if (marked[t]) front.push_back(t);
  }
  for (int ring = 0; ring < rings && !front.empty(); ++ring) {
    std::vector<std::uint32_t> next;
    for (const std::uint32_t triangle : front) {
      for (const std::uint32_t vertex : mesh.triangles[triangle]) {
        for (const std::uint32_t neighbour : adjacency.triangles_of_vertex(vertex)) {
          if (marked[neighbour]) continue;
          marked[neighbour] = true;
          next.push_back(neighbour);
        }
      }
    }
    front = std::move(next);
  }
}

}  // namespace asperity
