#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "asperity/geometry/triangle_mesh.h"

namespace asperity {

// Unit outward normals, one a triangle: (b − a) × (c − a) normalised. Zero for a degenerate triangle, one
// whose area is within rounding of zero. Indices are not checked; every answer is scale-free.
std::vector<Eigen::Vector3d> facet_normals(const TriangleMesh& mesh);

// Unit normals, one a vertex: the mean of its facets' normals, each weighted by the facet's angle at the
// vertex (Thürmer and Wüthrich 1998): it does not depend on how a flat or bent surface is triangulated.
// Zero for a vertex without facets, or whose facets cancel.
std::vector<Eigen::Vector3d> vertex_normals(const TriangleMesh& mesh);

// The unit normal at a point of a triangle: its corners' normals interpolated linearly; the facet's where
// they cancel or are zero.
Eigen::Vector3d interpolated_normal(const TriangleMesh& mesh, const std::vector<Eigen::Vector3d>& vertex_normals,
                                    std::uint32_t triangle, const Eigen::Vector3d& barycentric);

}  // namespace asperity
