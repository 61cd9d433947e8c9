#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>
#include <Eigen/Geometry>

#include "asperity/base/error.h"
#include "asperity/geometry/mesh_adjacency.h"
#include "asperity/geometry/mesh_normals.h"
#include "asperity/registration/registration_surface.h"

namespace asperity {
namespace {

double corner_angle(const TriangleMesh& mesh, const Triangle& t, std::size_t corner) {
  const Eigen::Vector3d& a = mesh.vertices_m[t[corner]];
  const Eigen::Vector3d u = mesh.vertices_m[t[(corner + 1) % 3]] - a;
  const Eigen::Vector3d v = mesh.vertices_m[t[(corner + 2) % 3]] - a;
  return std::atan2(u.cross(v).norm(), u.dot(v));
}

}  // namespace

RegistrationSurface prepare_surface(const TriangleMesh& mesh, const MeshBvh& bvh, double crease_deg) {
  if (mesh.triangles.empty()) throw Error("registration: the mesh has no triangles");
  if (!(crease_deg >= 0.0 && crease_deg <= 180.0)) {
    throw Error(fmt::format("registration: crease_deg is {}, not within 0 and 180", crease_deg));
  }
  const TriangleMesh welded = weld_vertices(mesh);
  const MeshAdjacency adjacency = make_adjacency(welded);
  const std::vector<Eigen::Vector3d> normals = facet_normals(welded);
  const double crease_cos = std::cos(crease_deg * std::numbers::pi / 180.0);

  RegistrationSurface out{&mesh, &bvh, std::vector<RegistrationFacet>(mesh.triangles.size())};
  for (std::uint32_t f = 0; f < out.facets.size(); ++f) {
    RegistrationFacet& facet = out.facets[f];
    facet.normal = normals[f].cast<float>();
    for (std::size_t corner = 0; corner < 3; ++corner) {
      if (adjacency.triangles_of_edge(adjacency.edge_of_triangle[f][corner]).size() == 1) facet.border |= 1U << corner;
      const std::uint32_t vertex = welded.triangles[f][corner];
      Eigen::Vector3d sum = Eigen::Vector3d::Zero();
      for (const std::uint32_t other : adjacency.triangles_of_vertex(vertex)) {
        if (normals[other].dot(normals[f]) < crease_cos) continue;
        const Triangle& t = welded.triangles[other];
        const auto at = static_cast<std::size_t>(std::find(t.begin(), t.end(), vertex) - t.begin());
        sum += corner_angle(welded, t, at) * normals[other];
      }
      const double length = sum.norm();
      facet.corner_normal[corner] = length > 0.0 ? (sum / length).cast<float>() : facet.normal;
    }
  }
  return out;
}

}  // namespace asperity
