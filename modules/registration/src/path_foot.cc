#include "path_foot.h"

#include <algorithm>
#include <cmath>

#include "asperity/geometry/flat_triangle.h"

namespace asperity {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr std::uint32_t kNone = MeshAdjacency::kNone;

double cross(const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

double distance_to_segment(const Vector2d& a, const Vector2d& b) {
  const Vector2d along = b - a;
  const double square = along.squaredNorm();
  const double u = square > 0.0 ? std::clamp(-a.dot(along) / square, 0.0, 1.0) : 0.0;
  return (a + u * along).norm();
}

// What is seen of an edge from the origin, between the directions `right` and `left`.
struct Window {
  std::uint32_t triangle;  // on the origin's side
  std::uint32_t edge;
  std::uint32_t right_vertex;
  std::uint32_t left_vertex;
  Vector2d right_end;
  Vector2d left_end;
  Vector2d right;
  Vector2d left;
};

}  // namespace

struct PathFeet::Search {
  const PathFeet& feet;
  double from_s_m;
  double to_s_m;
  double limit_m;
  PathFoot best;
  std::vector<Window> windows;

  // The nearest point of a piece of `triangle` between two directions; of all of it without them.
  void look(std::uint32_t triangle, const FlatTriangle& flat, const Window* between) {
    const auto found = feet.pieces_in_.find(triangle);
    if (found == feet.pieces_in_.end()) return;
    const bool turned =
        cross(flat.corner[1] - flat.corner[0], flat.corner[2] - flat.corner[0]) < 0.0;  // seen from inside
    for (const std::uint32_t i : found->second) {
      const PathPiece& piece = feet.pieces_[i];
      const Vector2d start = flat.at(piece.from);
      const Vector2d along = flat.at(piece.to) - start;
      double low = 0.0;
      double high = 1.0;
      const auto keep = [&](double value, double slope) {  // where value + u slope >= 0
        if (slope > 0.0) {
          low = std::max(low, -value / slope);
        } else if (slope < 0.0) {
          high = std::min(high, -value / slope);
        } else if (value < 0.0) {
          low = 2.0;
        }
      };
      if (between != nullptr) {
        keep(cross(between->right, start), cross(between->right, along));
        keep(cross(start, between->left), cross(along, between->left));
      }
      const double length_s_m = piece.to_s_m - piece.from_s_m;
      keep(piece.from_s_m - from_s_m, length_s_m);
      keep(to_s_m - piece.from_s_m, -length_s_m);
      const double square = along.squaredNorm();
      if (low > high || !(square > 0.0)) continue;
      const double u = std::clamp(-start.dot(along) / square, low, high);
      const Vector2d foot = start + u * along;
      const double distance_m = foot.norm();
      if (best.found ? distance_m >= best.distance_m : distance_m > limit_m) continue;
      const double length_m = std::sqrt(square);
      best.found = true;
      best.distance_m = limit_m = distance_m;
      best.s_m = piece.from_s_m + u * length_s_m;
      best.beyond_m = -foot.dot(along) / length_m;
      best.at_start = i == 0 && u == 0.0;
      best.at_end = i + 1 == feet.pieces_.size() && u == 1.0;
      const double left_m = cross(along, -foot) / length_m;
      const double side = (left_m > 0.0) == turned ? 1.0 : -1.0;
      best.across_m = best.at_start || best.at_end ? side * std::abs(left_m) : side * distance_m;
    }
  }

  void open(std::uint32_t triangle, const FlatTriangle& flat, std::size_t e) {
    const Triangle& tri = feet.mesh_.triangles[triangle];
    const std::size_t next = (e + 1) % 3;
    windows.push_back({triangle, feet.adjacency_.edge_of_triangle[triangle][e], tri[e], tri[next], flat.corner[e],
                       flat.corner[next], flat.corner[e], flat.corner[next]});
  }

  void run() {
    // Pieces are near, and the windows that reach them few; the limit stops what a broken mesh would start.
    constexpr std::size_t kMostWindows = 50'000;
    for (std::size_t i = 0; i < windows.size() && i < kMostWindows; ++i) {
      const Window w = windows[i];
      if (w.edge == kNone || distance_to_segment(w.right_end, w.left_end) >= limit_m) continue;
      for (const std::uint32_t next : feet.adjacency_.triangles_of_edge(w.edge)) {
        if (next != w.triangle) cross_into(next, w);
      }
    }
  }

  void cross_into(std::uint32_t next, const Window& w) {
    const auto& vertices = feet.mesh_.vertices_m;
    const Triangle& tri = feet.mesh_.triangles[next];
    FlatTriangle flat;
    std::size_t apex = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      if (tri[k] == w.right_vertex) {
        flat.corner[k] = w.right_end;
      } else if (tri[k] == w.left_vertex) {
        flat.corner[k] = w.left_end;
      } else {
        apex = k;
      }
    }
    const Vector2d place = place_beside(vertices[tri[apex]], vertices[w.right_vertex], vertices[w.left_vertex],
                                        w.right_end, w.left_end, -1.0);
    flat.corner[apex] = place;
    look(next, flat, &w);
    const bool sees_right = cross(w.right, place) > 0.0;
    const bool sees_left = cross(place, w.left) > 0.0;
    for (std::size_t e = 0; e < 3; ++e) {
      const std::uint32_t edge = feet.adjacency_.edge_of_triangle[next][e];
      const std::uint32_t a = tri[e];
      const std::uint32_t b = tri[(e + 1) % 3];
      const bool at_apex = a == tri[apex] || b == tri[apex];
      if (!at_apex) continue;
      const std::uint32_t other = a == tri[apex] ? b : a;
      if (other == w.right_vertex && sees_right) {
        windows.push_back({next, edge, other, tri[apex], w.right_end, place, w.right, sees_left ? place : w.left});
      } else if (other == w.left_vertex && sees_left) {
        windows.push_back({next, edge, tri[apex], other, place, w.left_end, sees_right ? place : w.right, w.left});
      }
    }
  }
};

PathFeet::PathFeet(const TriangleMesh& mesh, const MeshAdjacency& adjacency, const std::vector<PathPiece>& pieces)
    : mesh_(mesh), adjacency_(adjacency), pieces_(pieces) {
  for (std::uint32_t i = 0; i < pieces.size(); ++i) pieces_in_[pieces[i].triangle].push_back(i);
}

PathFoot PathFeet::of_vertex(std::uint32_t vertex, double limit_m, double from_s_m, double to_s_m) const {
  Search search{*this, from_s_m, to_s_m, limit_m, {}, {}};
  for (const std::uint32_t triangle : adjacency_.triangles_of_vertex(vertex)) {
    FlatTriangle flat = flatten_triangle(mesh_, triangle);
    const Triangle& tri = mesh_.triangles[triangle];
    const std::size_t k = tri[0] == vertex ? 0 : tri[1] == vertex ? 1 : 2;
    const Vector2d origin = flat.corner[k];
    for (Vector2d& corner : flat.corner) corner -= origin;
    search.look(triangle, flat, nullptr);
    search.open(triangle, flat, (k + 1) % 3);
  }
  search.run();
  return search.best;
}

PathFoot PathFeet::of_point(const MeshPoint& point, double limit_m, double from_s_m, double to_s_m) const {
  Search search{*this, from_s_m, to_s_m, limit_m, {}, {}};
  FlatTriangle flat = flatten_triangle(mesh_, point.triangle);
  const Vector2d origin = flat.at(point.barycentric);
  for (Vector2d& corner : flat.corner) corner -= origin;
  search.look(point.triangle, flat, nullptr);
  for (std::size_t e = 0; e < 3; ++e) search.open(point.triangle, flat, e);
  search.run();
  return search.best;
}

}  // namespace asperity
