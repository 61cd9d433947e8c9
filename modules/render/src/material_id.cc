#include "material_id.h"

#include <bit>

namespace asperity {

std::uint64_t material_id(const RenderModel& model) {
  std::uint64_t hash = 0x84222325cbf29ce4u;
  const auto add = [&](std::uint64_t word) {
    hash = (hash ^ word) * 0x9e3779b97f4a7c15u;
    hash ^= hash >> 29;
  };
  const auto add_number = [&](double x) { add(std::bit_cast<std::uint64_t>(x)); };
  const auto add_corners = [&](const std::vector<std::array<std::uint32_t, 3>>& triangles) {
    add(triangles.size());
    for (const auto& corners : triangles)
      for (const std::uint32_t k : corners) add(k);
  };
  add_number(model.config.border_fade_m);
  for (const RenderObject& object : model.objects) {
    add(object.materials.size());
    for (const RenderMaterial& material : object.materials) {
      add_number(material.stiffness_N_per_m);
      add_number(material.compliance_kc);
      add_number(material.friction);
      add_number(material.static_friction_ratio);
    }
    add_corners(object.corner_material);
    add_corners(object.bare_material);
    // Where materials fade at borders, these belong to it: they follow the textures and their coordinates.
    if (object.bare_material.empty()) continue;
    for (const std::int32_t texture : object.texture) add(static_cast<std::uint64_t>(texture));
    for (const auto& corners : object.texture_xy_m)
      for (const Eigen::Vector2d& xy_m : corners) add_number(xy_m.x()), add_number(xy_m.y());
  }
  return hash;
}

}  // namespace asperity
