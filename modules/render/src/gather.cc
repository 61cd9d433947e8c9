#include "gather.h"

#include <array>
#include <span>

namespace asperity {

using Eigen::Vector3d;

bool gather(const RenderModel& model, const Vector3d& centre_m, double radius_m, ObjectSet objects,
            NearTriangles& near) noexcept {
  near.centre_m = centre_m;
  near.radius_m = radius_m;
  near.count = 0;
  near.complete = true;
  std::array<std::uint32_t, NearTriangles::kMost> found;
  for (std::uint32_t o = 0; o < model.objects.size(); ++o) {
    if (!(objects >> o & 1u)) continue;
    const RenderObject& object = model.objects[o];
    const Pose& T = object.T_world_mesh;
    const bool turned = T.rotation.w() != 1.0 || T.translation_m != Vector3d::Zero();
    const Vector3d centre_mesh_m = turned ? T.rotation.conjugate() * (centre_m - T.translation_m) : centre_m;
    const std::size_t room = NearTriangles::kMost - near.count;
    const std::size_t count = object.bvh.triangles_within(centre_mesh_m, radius_m, std::span(found.data(), room));
    for (std::size_t k = 0; k < count && k < room; ++k) {
      const Triangle& corners = object.mesh.triangles[found[k]];
      NearTriangle& t = near.triangles[near.count++];
      t.a_m = object.mesh.vertices_m[corners[0]];
      t.b_m = object.mesh.vertices_m[corners[1]];
      t.c_m = object.mesh.vertices_m[corners[2]];
      t.normal = object.normals[found[k]];
      if (turned) {
        t.a_m = T * t.a_m, t.b_m = T * t.b_m, t.c_m = T * t.c_m;
        t.normal = T.rotation * t.normal;
      }
      t.object = o;
      t.triangle = found[k];
    }
    if (count > room) near.complete = false;
  }
  return near.complete;
}

}  // namespace asperity
