#include "surface_path.h"

#include <algorithm>
#include <cmath>

#include <Eigen/LU>

#include "asperity/algebra/solve.h"
#include "asperity/geometry/connected_point.h"
#include "asperity/geometry/flat_triangle.h"
#include "asperity/geometry/geodesic_path.h"
#include "asperity/geometry/straight_path.h"
#include "asperity/geometry/triangle_strip.h"

namespace asperity {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

// A path's points in the plane into which the triangles along it unfold.
struct Development {
  std::vector<Vector2d> place;
  std::vector<FlatTriangle> triangle;  // that of each point
};

TriangleStrip strip_between(const TriangleMesh& mesh, const MeshAdjacency& adjacency, const MeshPoint& from,
                            const MeshPoint& to) {
  for (const std::uint32_t edge : adjacency.edge_of_triangle[from.triangle]) {
    if (edge == MeshAdjacency::kNone) continue;
    for (const std::uint32_t next : adjacency.triangles_of_edge(edge)) {
      if (next == to.triangle && next != from.triangle) return {{from.triangle, next}, {edge}};
    }
  }
  return find_strip(mesh, adjacency, from, to);
}

Development develop_points(const TriangleMesh& mesh, const MeshAdjacency& adjacency,
                           const std::vector<MeshPoint>& points) {
  Development out;
  out.place.reserve(points.size());
  out.triangle.reserve(points.size());
  FlatTriangle flat = flatten_triangle(mesh, points[0].triangle);
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (i > 0 && points[i].triangle != points[i - 1].triangle) {
      const TriangleStrip strip = strip_between(mesh, adjacency, points[i - 1], points[i]);
      for (std::size_t k = 0; k < strip.edges.size(); ++k) {
        flat = flatten_over(mesh, strip.faces[k], flat, adjacency.edge_vertices[strip.edges[k]], strip.faces[k + 1]);
      }
    }
    out.place.push_back(flat.at(points[i].barycentric));
    out.triangle.push_back(flat);
  }
  return out;
}

// The plane of a flattened triangle in the mesh frame: columns are its axes.
Eigen::Matrix<double, 3, 2> axes(const TriangleMesh& mesh, std::uint32_t triangle, const FlatTriangle& flat) {
  const auto& [a, b, c] = mesh.triangles[triangle];
  Eigen::Matrix<double, 3, 2> edges;
  edges << mesh.vertices_m[b] - mesh.vertices_m[a], mesh.vertices_m[c] - mesh.vertices_m[a];
  Eigen::Matrix2d flat_edges;
  flat_edges << flat.corner[1] - flat.corner[0], flat.corner[2] - flat.corner[0];
  return edges * flat_edges.inverse();
}

// The value at `s` of the weighted least-squares quadratic through the places within the window; of a
// straight line where they are too few.
Vector2d smoothed(const std::vector<double>& s_m, const std::vector<Vector2d>& place, double s, double half_window_m) {
  // At the path's ends the window is moved inwards, not cut in half.
  const double middle = s_m.back() - s_m.front() > 2.0 * half_window_m
                            ? std::clamp(s, s_m.front() + half_window_m, s_m.back() - half_window_m)
                            : 0.5 * (s_m.front() + s_m.back());
  auto first = static_cast<std::size_t>(std::lower_bound(s_m.begin(), s_m.end(), middle - half_window_m) - s_m.begin());
  auto last = static_cast<std::size_t>(std::upper_bound(s_m.begin(), s_m.end(), middle + half_window_m) - s_m.begin());
  constexpr std::size_t kFewest = 5;
  while (last - first < std::min(kFewest, s_m.size())) {
    if (first > 0) --first;
    if (last < s_m.size()) ++last;
  }
  const double reach = std::max({half_window_m, middle - s_m[first], s_m[last - 1] - middle});
  const bool quadratic = last - first >= kFewest;
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Matrix<double, 3, 2> right = Eigen::Matrix<double, 3, 2>::Zero();
  const Vector2d& origin = place[first];
  for (std::size_t i = first; i < last; ++i) {
    const double u = (s_m[i] - s) / reach;
    const double from_middle = (s_m[i] - middle) / (1.001 * reach);
    const double weight = (1.0 - from_middle * from_middle) * (1.0 - from_middle * from_middle);
    const Vector3d row(1.0, u, quadratic ? u * u : 0.0);
    normal += weight * row * row.transpose();
    right += weight * row * (place[i] - origin).transpose();
  }
  if (!quadratic) normal(2, 2) = 1.0;
  return origin + Vector2d(least_squares(normal, right).x.row(0).transpose());
}

void join_points(const TriangleMesh& mesh, const MeshAdjacency& adjacency, const MeshPoint& from, const MeshPoint& to,
                 double from_s_m, double to_s_m, SurfacePath& out) {
  if (from.triangle == to.triangle) {
    out.length_m += (position_m(mesh, to) - position_m(mesh, from)).norm();
    out.pieces.push_back({from.triangle, from.barycentric, to.barycentric, from_s_m, to_s_m});
    return;
  }
  const MeshPath path = geodesic_path(mesh, adjacency, from, to).path;
  const double length_m = path.s_m.back();
  for (std::size_t i = 0; i + 1 < path.size(); ++i) {
    if (path.s_m[i + 1] <= path.s_m[i]) continue;
    const auto s_at = [&](std::size_t k) { return from_s_m + (to_s_m - from_s_m) * path.s_m[k] / length_m; };
    out.pieces.push_back({path.triangle[i], weights_of(mesh, path.triangle[i], path.p_mesh_m[i]),
                          weights_of(mesh, path.triangle[i], path.p_mesh_m[i + 1]), s_at(i), s_at(i + 1)});
  }
  out.length_m += length_m;
}

}  // namespace

SurfacePath make_surface_path(const TriangleMesh& mesh, const MeshAdjacency& adjacency, const MeshPath& path,
                              double half_window_m, double edge_m) {
  SurfacePath out;
  out.points.reserve(path.size());
  for (std::size_t i = 0; i < path.size(); ++i)
    out.points.push_back(connected_point(mesh, adjacency, path.triangle[i], path.p_mesh_m[i]));
  for (std::size_t i = 1; i < path.size(); ++i) {
    const double apart_m = (path.p_mesh_m[i] - path.p_mesh_m[i - 1]).norm();
    if (apart_m > 2.0 * edge_m + 2.0 * (path.s_m[i] - path.s_m[i - 1])) ++out.jumps;
  }
  std::vector<double> s_m;
  std::vector<MeshPoint> points;
  if (half_window_m > 0.0) {
    const Development flat = develop_points(mesh, adjacency, out.points);
    const double length_m = path.s_m.back() - path.s_m.front();
    const auto steps = static_cast<std::size_t>(std::clamp(4.0 * length_m / edge_m, 4.0, 1e5));
    std::size_t nearest = 0;
    for (std::size_t k = 0; k <= steps; ++k) {
      const double s = path.s_m.front() + length_m * static_cast<double>(k) / static_cast<double>(steps);
      while (nearest + 1 < path.size() && std::abs(path.s_m[nearest + 1] - s) <= std::abs(path.s_m[nearest] - s))
        ++nearest;
      const Vector2d offset = smoothed(path.s_m, flat.place, s, half_window_m) - flat.place[nearest];
      const MeshPoint& from = out.points[nearest];
      const Vector3d direction = axes(mesh, from.triangle, flat.triangle[nearest]) * offset;
      s_m.push_back(s);
      points.push_back(direction.allFinite() ? straight_path(mesh, adjacency, from, direction, offset.norm()).end
                                             : from);
    }
  } else {
    s_m = path.s_m;
    points = out.points;
  }
  for (std::size_t i = 0; i + 1 < points.size(); ++i)
    join_points(mesh, adjacency, points[i], points[i + 1], s_m[i], s_m[i + 1], out);
  // Pieces as short as rounding have no direction.
  std::erase_if(out.pieces, [&](const PathPiece& piece) {
    return (position_m(mesh, {piece.triangle, piece.to}) - position_m(mesh, {piece.triangle, piece.from})).norm() <=
           1e-6 * edge_m;
  });
  return out;
}

std::vector<PathPiece> extend_path(const TriangleMesh& mesh, const MeshAdjacency& adjacency, const SurfacePath& path,
                                   bool backwards, double by_m) {
  std::vector<PathPiece> out;
  if (path.pieces.empty() || !(by_m > 0.0)) return out;
  const PathPiece& end = backwards ? path.pieces.front() : path.pieces.back();
  const Vector3d along = position_m(mesh, {end.triangle, end.to}) - position_m(mesh, {end.triangle, end.from});
  const MeshPoint start{end.triangle, backwards ? end.from : end.to};
  const MeshPath line = straight_path(mesh, adjacency, start, backwards ? Vector3d(-along) : along, by_m).path;
  const double sign = backwards ? -1.0 : 1.0;
  const double s_m = backwards ? end.from_s_m : end.to_s_m;
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    PathPiece piece{line.triangle[i], weights_of(mesh, line.triangle[i], line.p_mesh_m[i]),
                    weights_of(mesh, line.triangle[i], line.p_mesh_m[i + 1]), s_m + sign * line.s_m[i],
                    s_m + sign * line.s_m[i + 1]};
    if (piece.from == piece.to) continue;
    if (backwards) {
      std::swap(piece.from, piece.to);
      std::swap(piece.from_s_m, piece.to_s_m);
    }
    out.push_back(piece);
  }
  if (backwards) std::reverse(out.begin(), out.end());
  return out;
}

}  // namespace asperity
