#include "asperity/geometry/straight_path.h"

#include <cmath>
#include <limits>
#include <string>

#include <Eigen/Geometry>

#include "asperity/base/error.h"
#include "asperity/base/text.h"
#include "asperity/geometry/flat_triangle.h"

namespace asperity {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr std::uint32_t kNone = MeshAdjacency::kNone;

// The unit vector in a triangle's plane that is square to the edge from a to b and points to the apex.
Vector3d inward(const TriangleMesh& mesh, std::uint32_t triangle, std::uint32_t a, std::uint32_t b) {
  Vector3d out = Vector3d::Zero();
  const Vector3d along = (mesh.vertices_m[b] - mesh.vertices_m[a]).normalized();
  for (const std::uint32_t v : mesh.triangles[triangle]) {
    if (v == a || v == b) continue;
    const Vector3d up = mesh.vertices_m[v] - mesh.vertices_m[a];
    out = (up - up.dot(along) * along).normalized();
  }
  return out;
}

std::uint32_t next_triangle(const TriangleMesh& mesh, const MeshAdjacency& adjacency, std::uint32_t triangle,
                            std::uint32_t edge) {
  if (edge == kNone) return kNone;
  const auto triangles = adjacency.triangles_of_edge(edge);
  if (triangles.size() == 2) return triangles[0] == triangle ? triangles[1] : triangles[0];
  const auto [a, b] = adjacency.edge_vertices[edge];
  const Vector3d back = inward(mesh, triangle, a, b);
  std::uint32_t best = kNone;
  double best_bend = std::numeric_limits<double>::infinity();
  for (const std::uint32_t other : triangles) {
    if (other == triangle) continue;
    const double bend = back.dot(inward(mesh, other, a, b));  // -1 for straight on
    if (bend < best_bend) {
      best_bend = bend;
      best = other;
    }
  }
  return best;
}

}  // namespace

StraightPath straight_path(const TriangleMesh& mesh, const MeshAdjacency& adjacency, const MeshPoint& from,
                           const Vector3d& direction, double length_m) {
  if (from.triangle >= mesh.triangles.size() || adjacency.edge_of_triangle.size() != mesh.triangles.size())
    throw Error("straight path: triangle " + std::to_string(from.triangle) + " is not on the mesh");
  if (!(length_m >= 0.0) || !std::isfinite(length_m))
    throw Error("straight path: a length of " + number_text(length_m) + " m");

  StraightPath out;
  std::uint32_t triangle = from.triangle;
  FlatTriangle flat = flatten_triangle(mesh, triangle);
  Vector3d weight = from.barycentric;
  Vector3d p = position_m(mesh, from);
  const auto add = [&] {
    out.path.s_m.push_back(out.path.p_mesh_m.empty() ? 0.0
                                                     : out.path.s_m.back() + (p - out.path.p_mesh_m.back()).norm());
    out.path.p_mesh_m.push_back(p);
    out.path.triangle.push_back(triangle);
  };
  // The direction in the plane of the first triangle, whose frame is its first edge and its normal.
  const auto frame = [&](std::uint32_t t, const FlatTriangle& f) {
    const auto& [ia, ib, ic] = mesh.triangles[t];
    Eigen::Matrix<double, 3, 2> edges;
    edges << mesh.vertices_m[ib] - mesh.vertices_m[ia], mesh.vertices_m[ic] - mesh.vertices_m[ia];
    Eigen::Matrix2d flat_edges;
    flat_edges << f.corner[1] - f.corner[0], f.corner[2] - f.corner[0];
    return Eigen::Matrix<double, 3, 2>(edges * flat_edges.inverse());  // columns: the plane's axes in the mesh frame
  };
  Vector2d heading = frame(triangle, flat).transpose() * direction;
  const double size = heading.norm();
  add();
  out.end = from;
  if (!(size > 0.0) || !std::isfinite(size)) {
    out.whole = length_m == 0.0;
    return out;
  }
  heading /= size;
  std::size_t entered_over = 3;  // the corner opposite the edge by which the triangle was entered
  double left_m = length_m;
  // A straight line crosses a triangle again only by going round; the limit ends it where rounding would not.
  for (std::size_t crossings = 0; crossings <= 4 * mesh.triangles.size() + 16; ++crossings) {
    const Vector3d change = flat.barycentric(flat.corner[0] + heading) - Vector3d::UnitX();
    if (!change.allFinite()) {
      out.whole = false;
      break;
    }
    double reach_m = std::numeric_limits<double>::infinity();
    std::size_t opposite = 3;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto i = static_cast<Eigen::Index>(k);
      if (k == entered_over || !(change[i] < 0.0)) continue;
      const double t = std::max(0.0, weight[i] / -change[i]);
      if (t < reach_m) {
        reach_m = t;
        opposite = k;
      }
    }
    if (left_m <= reach_m || opposite == 3) {
      weight += left_m * change;
      weight = weight.cwiseMax(0.0);
      weight /= weight.sum();
      break;
    }
    weight += reach_m * change;
    weight[static_cast<Eigen::Index>(opposite)] = 0.0;
    weight = weight.cwiseMax(0.0);
    weight /= weight.sum();
    left_m -= reach_m;
    const std::uint32_t edge = adjacency.edge_of_triangle[triangle][(opposite + 1) % 3];
    const std::uint32_t next = next_triangle(mesh, adjacency, triangle, edge);
    if (next == kNone) {
      out.whole = left_m == 0.0;
      break;
    }
    flat = flatten_over(mesh, triangle, flat, adjacency.edge_vertices[edge], next);
    Vector3d carried = Vector3d::Zero();
    for (std::size_t i = 0; i < 3; ++i) {
      bool shared = false;
      for (std::size_t k = 0; k < 3; ++k) {
        if (mesh.triangles[next][i] != mesh.triangles[triangle][k]) continue;
        carried[static_cast<Eigen::Index>(i)] = weight[static_cast<Eigen::Index>(k)];
        shared = true;
      }
      if (!shared) entered_over = i;
    }
    weight = carried;
    triangle = next;
    p = position_m(mesh, {triangle, weight});
    add();
  }
  out.end = {triangle, weight};
  p = position_m(mesh, out.end);
  add();
  out.direction = (frame(triangle, flat) * heading).normalized();
  return out;
}

}  // namespace asperity
