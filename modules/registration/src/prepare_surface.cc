#include <numbers>

#include <fmt/format.h>

#include "asperity/base/error.h"
#include "asperity/geometry/corner_normals.h"
#include "asperity/geometry/mesh_adjacency.h"
#include "asperity/geometry/mesh_normals.h"
#include "asperity/registration/registration_surface.h"
#include "distance_grid.h"

namespace asperity {
RegistrationSurface prepare_surface(const TriangleMesh& mesh, const MeshBvh& bvh, double crease_deg) {
  if (mesh.triangles.empty()) throw Error("registration: the mesh has no triangles");
  if (!(crease_deg >= 0.0 && crease_deg <= 180.0)) {
    throw Error(fmt::format("registration: crease_deg is {}, not within 0 and 180", crease_deg));
  }
  const TriangleMesh welded = weld_vertices(mesh);
  const MeshAdjacency adjacency = make_adjacency(welded);
  const std::vector<Eigen::Vector3d> normals = facet_normals(welded);
  const auto corners = corner_normals(welded, adjacency, crease_deg * std::numbers::pi / 180.0);

  RegistrationSurface out{&mesh, &bvh, std::vector<RegistrationFacet>(mesh.triangles.size()),
                          std::make_shared<registration::SearchGrid>()};
  for (std::uint32_t f = 0; f < out.facets.size(); ++f) {
    RegistrationFacet& facet = out.facets[f];
    facet.normal = normals[f].cast<float>();
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const std::uint32_t edge = adjacency.edge_of_triangle[f][corner];
      if (edge != MeshAdjacency::kNone && adjacency.triangles_of_edge(edge).size() == 1) facet.border |= 1U << corner;
      facet.corner_normal[corner] = corners[f][corner].cast<float>();
    }
  }
  return out;
}

}  // namespace asperity
