#include "surface_place.h"

#include <Eigen/Geometry>

#include "texture_border.h"

namespace asperity {

using Eigen::Vector2d;
using Eigen::Vector3d;

namespace {

RenderMaterial mean_of(const RenderObject& object, const std::array<std::uint32_t, 3>& corners,
                       const Vector3d& barycentric) {
  RenderMaterial out{0.0, 0.0, 0.0};
  for (std::size_t k = 0; k < 3; ++k) {
    const RenderMaterial& corner = object.materials[corners[k]];
    const double weight = barycentric[static_cast<Eigen::Index>(k)];
    out.stiffness_N_per_m += weight * corner.stiffness_N_per_m;
    out.compliance_kc += weight * corner.compliance_kc;
    out.friction += weight * corner.friction;
  }
  return out;
}

double fade_at(const RenderModel& model, const RenderObject& object, std::uint32_t triangle,
               const Vector3d& barycentric) {
  if (!object.border.edges) return 1.0;
  const Triangle& t = object.mesh.triangles[triangle];
  const auto corner = [&](std::size_t k) -> const Vector3d& { return object.mesh.vertices_m[t[k]]; };
  return border_fade(object, barycentric[0] * corner(0) + barycentric[1] * corner(1) + barycentric[2] * corner(2),
                     model.config.border_fade_m);
}

}  // namespace

RenderMaterial material_of(const RenderModel& model, const RenderObject& object, std::uint32_t triangle,
                           const Vector3d& barycentric) noexcept {
  if (object.corner_material.empty()) return object.materials[0];
  const RenderMaterial own = mean_of(object, object.corner_material[triangle], barycentric);
  if (object.bare_material.empty() || object.bare_material[triangle] == object.corner_material[triangle]) return own;
  const double fade = fade_at(model, object, triangle, barycentric);
  return fade < 1.0 ? between(mean_of(object, object.bare_material[triangle], barycentric), own, fade) : own;
}

TexturePlace texture_place(const RenderModel& model, const RenderObject& object, std::uint32_t triangle,
                           const Vector3d& barycentric) noexcept {
  TexturePlace out;
  if (object.texture.empty() || object.texture[triangle] < 0) return out;
  out.texture = &model.textures[static_cast<std::size_t>(object.texture[triangle])];
  const auto& xy = object.texture_xy_m[triangle];
  out.xy_m = barycentric[0] * xy[0] + barycentric[1] * xy[1] + barycentric[2] * xy[2];
  const Triangle& t = object.mesh.triangles[triangle];
  const auto corner = [&](std::size_t k) -> const Vector3d& { return object.mesh.vertices_m[t[k]]; };
  out.fade = fade_at(model, object, triangle, barycentric);
  const Vector3d e1 = corner(1) - corner(0);
  const Vector3d e2 = corner(2) - corner(0);
  const Vector3d area = e1.cross(e2);
  const double square = area.squaredNorm();
  if (!(square > 0.0)) return out;
  // The dual basis of the two edges: e1 · g1 = 1, e2 · g1 = 0, and the other way round.
  const Eigen::Quaterniond& R = object.T_world_mesh.rotation;
  const Vector3d g1 = R * Vector3d(e2.cross(area) / square), g2 = R * Vector3d(area.cross(e1) / square);
  const Vector2d d1 = xy[1] - xy[0], d2 = xy[2] - xy[0];
  out.x_gradient = d1.x() * g1 + d2.x() * g2;
  out.y_gradient = d1.y() * g1 + d2.y() * g2;
  return out;
}

}  // namespace asperity
