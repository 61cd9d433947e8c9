#include "asperity/geometry/mesh_surface.h"

#include <algorithm>
#include <cmath>

#include <Eigen/LU>

#include "asperity/geometry/corner_normals.h"

namespace asperity {

namespace {

// In barycentric units: a foot this far outside a triangle still counts as on its edge.
constexpr double kEdgeSlack = 1e-9;
constexpr int kNewtonSteps = 8;
constexpr int kTriangleSteps = 64;

struct Solution {
  Eigen::Vector3d barycentric = Eigen::Vector3d::Zero();
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();  // interpolated, not of unit length
  double h = 0.0;                                    // in lengths of `normal`
  bool found = false;
};

// v0 + w1 e1 + w2 e2 + h (n0 + w1 d1 + w2 d2) = p, w unbounded.
Solution solve_in_plane(const MeshSurface& surface, std::uint32_t triangle, const Eigen::Vector3d& p_m,
                        const Eigen::Vector3d& start) noexcept {
  const Triangle& corner = surface.mesh.triangles[triangle];
  const Eigen::Vector3d& v0 = surface.mesh.vertices_m[corner[0]];
  const Eigen::Vector3d e1 = surface.mesh.vertices_m[corner[1]] - v0, e2 = surface.mesh.vertices_m[corner[2]] - v0;
  const auto& normals = surface.normals[triangle];
  const Eigen::Vector3d& n0 = normals[0];
  const Eigen::Vector3d d1 = normals[1] - n0, d2 = normals[2] - n0;
  const double size_m = std::sqrt(std::max(e1.squaredNorm(), e2.squaredNorm()));
  double w1 = start[1], w2 = start[2];
  Solution out;
  out.normal = n0 + w1 * d1 + w2 * d2;
  if (!(out.normal.squaredNorm() > 0.0)) return out;
  out.h = (p_m - (v0 + w1 * e1 + w2 * e2)).dot(out.normal) / out.normal.squaredNorm();
  for (int step = 0; step < kNewtonSteps; ++step) {
    const Eigen::Vector3d residual_m = v0 + w1 * e1 + w2 * e2 + out.h * out.normal - p_m;
    Eigen::Matrix3d jacobian;
    jacobian << e1 + out.h * d1, e2 + out.h * d2, out.normal;
    bool invertible = false;
    Eigen::Matrix3d inverse;
    double determinant = 0.0;
    jacobian.computeInverseAndDetWithCheck(inverse, determinant, invertible, 0.0);
    if (!invertible) return out;
    const Eigen::Vector3d change = inverse * residual_m;
    w1 -= change[0];
    w2 -= change[1];
    out.h -= change[2];
    if (!std::isfinite(w1) || !std::isfinite(w2) || !std::isfinite(out.h)) return out;
    // Far outside, the triangle's own extension says only in which direction to go on.
    w1 = std::clamp(w1, -4.0, 5.0);
    w2 = std::clamp(w2, -4.0, 5.0);
    out.normal = n0 + w1 * d1 + w2 * d2;
    if (change.head<2>().cwiseAbs().maxCoeff() * size_m <= 1e-14 * (size_m + std::abs(out.h)) || step > 5) break;
  }
  out.barycentric = {1.0 - w1 - w2, w1, w2};
  out.found = true;
  return out;
}

NormalFoot foot_at(const MeshSurface& surface, const Eigen::Vector3d& p_m, std::uint32_t triangle,
                   const Eigen::Vector3d& barycentric, bool on_normal) noexcept {
  const Triangle& corner = surface.mesh.triangles[triangle];
  NormalFoot foot;
  foot.triangle = triangle;
  foot.barycentric = barycentric;
  for (int k = 0; k < 3; ++k) {
    const auto i = static_cast<std::size_t>(k);
    foot.p_m += barycentric[k] * surface.mesh.vertices_m[corner[i]];
    foot.normal += barycentric[k] * surface.normals[triangle][i];
  }
  const double length = foot.normal.norm();
  if (length > 0.0) foot.normal /= length;
  foot.height_m = (p_m - foot.p_m).dot(foot.normal);
  foot.on_normal = on_normal;
  return foot;
}

}  // namespace

MeshSurface::MeshSurface(const TriangleMesh& triangles, const Observer& observer)
    : mesh(weld_vertices(triangles)),
      adjacency((observer.update("mesh", 0.2), make_adjacency(mesh))),
      normals((observer.update("mesh", 0.4), corner_normals(mesh, adjacency))),
      bvh(mesh, observer) {}

std::uint32_t triangle_across(const MeshAdjacency& adjacency, std::uint32_t triangle, std::size_t edge) noexcept {
  const std::uint32_t index = adjacency.edge_of_triangle[triangle][edge];
  if (index == MeshAdjacency::kNone) return ClosestPoint::kNone;
  const auto sharing = adjacency.triangles_of_edge(index);
  if (sharing.size() != 2) return ClosestPoint::kNone;
  return sharing[0] == triangle ? sharing[1] : sharing[0];
}

double facet_bulge_m(const MeshSurface& surface, std::uint32_t triangle, const Eigen::Vector3d& barycentric) noexcept {
  const Triangle& corner = surface.mesh.triangles[triangle];
  const auto& normals = surface.normals[triangle];
  double sum_m = 0.0;
  for (std::size_t a = 0; a < 3; ++a) {
    const std::size_t b = (a + 1) % 3;
    const Eigen::Vector3d edge_m = surface.mesh.vertices_m[corner[b]] - surface.mesh.vertices_m[corner[a]];
    sum_m += barycentric[static_cast<Eigen::Index>(a)] * barycentric[static_cast<Eigen::Index>(b)] *
             edge_m.dot(normals[b] - normals[a]);
  }
  return 0.5 * sum_m;
}

NormalFoot foot_along_normal(const MeshSurface& surface, const Eigen::Vector3d& p_m,
                             const ClosestPoint& closest) noexcept {
  if (!closest.found()) return {};
  std::uint32_t triangle = closest.triangle, before = ClosestPoint::kNone;
  Eigen::Vector3d start = closest.barycentric;
  for (int step = 0; step < kTriangleSteps; ++step) {
    const Solution solution = solve_in_plane(surface, triangle, p_m, start);
    if (!solution.found) break;
    Eigen::Vector3d w = solution.barycentric;
    int outside = 0;
    const double lowest = w.minCoeff(&outside);
    if (lowest >= -kEdgeSlack) {
      w = w.cwiseMax(0.0);
      return foot_at(surface, p_m, triangle, w / w.sum(), true);
    }
    // Edge e runs from corner e to the next; the one across from corner k is k + 1.
    const std::uint32_t next = triangle_across(surface.adjacency, triangle, static_cast<std::size_t>(outside + 1) % 3);
    if (next == ClosestPoint::kNone || next == before) break;
    before = triangle;
    triangle = next;
    start = Eigen::Vector3d::Constant(1.0 / 3.0);
  }
  return foot_at(surface, p_m, closest.triangle, closest.barycentric, false);
}

}  // namespace asperity
