#pragma once

#include <cstdint>
#include <vector>

#include "asperity/geometry/triangle_mesh.h"

namespace bench {

// Points to ask a mesh about, in metres.
struct QueryPatterns {
  std::vector<Eigen::Vector3d> near;    // within 1 mm of the surface along its normal, in random order
  std::vector<Eigen::Vector3d> random;  // evenly in the box of the mesh
  std::vector<Eigen::Vector3d> path;    // a curve within 1 mm of the surface in steps of about 0.1 mm
};

// `count` points of each kind. Deterministic in `seed`.
QueryPatterns make_query_patterns(const asperity::TriangleMesh& mesh, std::size_t count, std::uint64_t seed);

// A closed torus with bumps, 2 rows × columns triangles, 120 mm across.
asperity::TriangleMesh bumpy_torus(std::uint32_t rows, std::uint32_t columns);

// Every triangle split in four at the middles of its edges.
asperity::TriangleMesh subdivide(const asperity::TriangleMesh& mesh);

// Scaled so that the longest side of its box, which must not be 0, is `size_m`.
asperity::TriangleMesh scaled_to(asperity::TriangleMesh mesh, double size_m);

}  // namespace bench
