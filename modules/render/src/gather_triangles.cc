#include "gather_triangles.h"

#include <array>
#include <span>

namespace asperity {

using Eigen::Vector3d;

namespace {

bool is_turned(const Pose& T) { return T.rotation.w() != 1.0 || T.translation_m != Vector3d::Zero(); }

NearTriangle in_world(const RenderObject& object, bool turned, std::uint32_t index, std::uint32_t triangle) {
  const Triangle& corners = object.mesh.triangles[triangle];
  NearTriangle t{object.mesh.vertices_m[corners[0]],
                 object.mesh.vertices_m[corners[1]],
                 object.mesh.vertices_m[corners[2]],
                 object.normals[triangle],
                 index,
                 triangle};
  if (turned) {
    const Pose& T = object.T_world_mesh;
    t.a_m = T * t.a_m, t.b_m = T * t.b_m, t.c_m = T * t.c_m;
    t.normal = T.rotation * t.normal;
  }
  return t;
}

}  // namespace

bool gather_triangles(const RenderModel& model, const Vector3d& centre_m, double radius_m, ObjectSet objects,
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
    const bool turned = is_turned(T);
    const Vector3d centre_mesh_m = turned ? T.rotation.conjugate() * (centre_m - T.translation_m) : centre_m;
    const std::size_t room = NearTriangles::kMost - near.count;
    const std::size_t count = object.bvh.triangles_within(centre_mesh_m, radius_m, std::span(found.data(), room));
    for (std::size_t k = 0; k < count && k < room; ++k) {
      near.triangles[near.count++] = in_world(object, turned, o, found[k]);
    }
    if (count > room) near.complete = false;
  }
  return near.complete;
}

bool add_triangle(const RenderModel& model, std::uint32_t object, std::uint32_t triangle,
                  NearTriangles& near) noexcept {
  if (near.count == NearTriangles::kMost) return false;
  for (std::uint32_t i = 0; i < near.count; ++i)
    if (near.triangles[i].object == object && near.triangles[i].triangle == triangle) return false;
  const RenderObject& from = model.objects[object];
  near.triangles[near.count++] = in_world(from, is_turned(from.T_world_mesh), object, triangle);
  return true;
}

}  // namespace asperity
