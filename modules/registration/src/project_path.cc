#include "asperity/registration/project_path.h"

#include <cmath>

#include <fmt/format.h>
#include <Eigen/Geometry>

#include "asperity/base/error.h"

namespace asperity {

PathProjection project_path(std::span<const Eigen::Vector3d> p_world_m, const TriangleMesh& mesh, const MeshBvh& bvh,
                            const Pose& T_mesh_world) {
  PathProjection out;
  out.path.p_mesh_m.reserve(p_world_m.size());
  out.path.triangle.reserve(p_world_m.size());
  out.path.s_m.reserve(p_world_m.size());
  out.barycentric.reserve(p_world_m.size());
  out.distance_m.reserve(p_world_m.size());
  ClosestPoint q;
  double s_m = 0.0;
  for (std::size_t i = 0; i < p_world_m.size(); ++i) {
    const Eigen::Vector3d p_m = T_mesh_world * p_world_m[i];
    if (!p_m.allFinite()) throw Error(fmt::format("projection onto the mesh: point {} is not finite", i));
    q = q.found() ? bvh.closest_point(p_m, q) : bvh.closest_point(p_m);
    if (!q.found()) throw Error(fmt::format("projection onto the mesh: point {} has no closest point", i));
    if (i > 0) s_m += (q.p_m - out.path.p_mesh_m.back()).norm();
    const Triangle& t = mesh.triangles.at(q.triangle);
    const Eigen::Vector3d& a = mesh.vertices_m[t[0]];
    const Eigen::Vector3d normal = (mesh.vertices_m[t[1]] - a).cross(mesh.vertices_m[t[2]] - a);
    out.path.p_mesh_m.push_back(q.p_m);
    out.path.triangle.push_back(q.triangle);
    out.path.s_m.push_back(s_m);
    out.barycentric.push_back(q.barycentric);
    out.distance_m.push_back(std::copysign(q.distance_m, normal.dot(p_m - q.p_m)));
  }
  return out;
}

}  // namespace asperity
