#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "asperity/geometry/mesh_adjacency.h"
#include "asperity/geometry/mesh_bvh.h"
#include "asperity/geometry/triangle_mesh.h"

namespace asperity {

// A mesh with all that is asked of it along a path: its neighbours, its normals and its closest points. Vertices
// at the same position are one, so that a surface continues over seams.
struct MeshSurface {
  // Throws Error and Cancelled as MeshBvh does.
  explicit MeshSurface(const TriangleMesh& triangles, const Observer& observer = {});

  TriangleMesh mesh;
  MeshAdjacency adjacency;
  std::vector<std::array<Eigen::Vector3d, 3>> normals;  // of the triangles' corners (corner_normals.h)
  MeshBvh bvh;
};

// The triangle across edge `edge` (from corner `edge` to the next), or ClosestPoint::kNone at a border, where
// more than two meet, and of a triangle that names a vertex twice.
std::uint32_t triangle_across(const MeshAdjacency& adjacency, std::uint32_t triangle, std::size_t edge) noexcept;

// The point of a mesh from which the interpolated normal leads to another point.
struct NormalFoot {
  std::uint32_t triangle = ClosestPoint::kNone;
  Eigen::Vector3d barycentric = Eigen::Vector3d::Zero();
  Eigen::Vector3d p_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();  // unit, interpolated
  double height_m = 0.0;                             // (p - p_m)·normal
  bool on_normal = false;                            // false: beyond a border or a fold; p_m is the closest point then
};

// The foot of `p_m` along the interpolated normals: b on a triangle and h with b + h n(b) = p. Unlike the
// closest point it moves smoothly over edges, and it undoes a displacement along the normals exactly
// (Kobbelt, Vorsatz and Seidel 1999; Panozzo et al. 2013). Newton's method in a triangle, from triangle to
// triangle over the edges, beginning at `closest`, the closest point to p.
NormalFoot foot_along_normal(const MeshSurface& surface, const Eigen::Vector3d& p_m,
                             const ClosestPoint& closest) noexcept;

// The height over a flat triangle, at `barycentric`, of the curved surface that has the corners' normals: with edges d
// from a to b, ½ Σ w_a w_b d·(n_b − n_a) over the three edges, the quadratic that is a circle's arc over each edge to
// second order (the normal part of Nagata's patch, 2005). Positive where the surface is convex; continuous over edges.
double facet_bulge_m(const MeshSurface& surface, std::uint32_t triangle, const Eigen::Vector3d& barycentric) noexcept;

}  // namespace asperity
