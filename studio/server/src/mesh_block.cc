#include "mesh_block.h"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "asperity/base/error.h"
#include "asperity/geometry/mesh_normals.h"
#include "asperity/studio/calls.h"
#include "json_pose.h"

namespace asperity::studio {

namespace {

std::vector<float> floats_about(const std::vector<Eigen::Vector3d>& points, const Eigen::Vector3d& origin) {
  std::vector<float> out;
  out.reserve(3 * points.size());
  for (const Eigen::Vector3d& p : points) {
    for (Eigen::Index k = 0; k < 3; ++k) out.push_back(static_cast<float>(p[k] - origin[k]));
  }
  return out;
}

}  // namespace

BlockWriter mesh_block(std::string_view kind, const TriangleMesh& mesh) {
  if (mesh.triangles.empty()) throw Advice("the mesh has no triangles", "Choose another mesh.");
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& p_m : mesh.vertices_m) {
    if (!p_m.allFinite())
      throw Advice("the mesh has a vertex that is not finite", "Repair the file, or choose another mesh.");
    box.extend(p_m);
  }
  const Eigen::Vector3d origin_m = box.center();
  std::vector<std::uint32_t> indices;
  indices.reserve(3 * mesh.triangles.size());
  for (const Triangle& triangle : mesh.triangles) indices.insert(indices.end(), triangle.begin(), triangle.end());

  BlockWriter out(kind);
  out.head()["origin_m"] = json_of_point(origin_m);
  out.head()["low_m"] = json_of_point(box.min());
  out.head()["high_m"] = json_of_point(box.max());
  const std::size_t vertices = mesh.vertices_m.size();
  out.add("positions", std::span<const float>(floats_about(mesh.vertices_m, origin_m)), {vertices, 3});
  out.add("indices", std::span<const std::uint32_t>(indices), {mesh.triangles.size(), 3});
  out.add("normals", std::span<const float>(floats_about(vertex_normals(mesh), Eigen::Vector3d::Zero())),
          {vertices, 3});
  return out;
}

}  // namespace asperity::studio
