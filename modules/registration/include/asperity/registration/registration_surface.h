#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include <Eigen/Core>

#include "asperity/geometry/mesh_bvh.h"
#include "asperity/geometry/triangle_mesh.h"

namespace asperity {

namespace registration {
class SearchGrid;
}

// What registration asks of a triangle beside its closest point. Directions in float: they steer steps, the
// distances stay double.
struct RegistrationFacet {
  Eigen::Vector3f normal = Eigen::Vector3f::Zero();  // unit, outward; zero for a degenerate triangle
  std::array<Eigen::Vector3f, 3> corner_normal{Eigen::Vector3f::Zero(), Eigen::Vector3f::Zero(),
                                               Eigen::Vector3f::Zero()};
  std::uint32_t border = 0;  // bit e: the edge from corner e to e + 1 belongs to no other triangle
};

// A mesh made ready for registration, once for any number of paths. It refers to `mesh` and `bvh`, which must
// outlive it.
struct RegistrationSurface {
  const TriangleMesh* mesh = nullptr;
  const MeshBvh* bvh = nullptr;
  std::vector<RegistrationFacet> facets;  // one a triangle
  // Distances for the search over the whole mesh, made by the first search and shared by copies; threads may share it.
  std::shared_ptr<registration::SearchGrid> search_grid;
};

// Normals at the corners are those of geometry/corner_normals.h with edges sharper than `crease_deg` kept. Vertices at
// the same position count as one (geometry/mesh_adjacency.h). Throws Error for an empty mesh or an index out of range.
RegistrationSurface prepare_surface(const TriangleMesh& mesh, const MeshBvh& bvh, double crease_deg = 40.0);

}  // namespace asperity
