#pragma once

#include <cstdint>

#include <Eigen/Core>

#include "asperity/render/render_model.h"

namespace asperity {

// The material at a point of an object's triangle, interpolated over its corners. What a texture brings fades towards
// the texture's border as its heights do: there the material is that without texture. Realtime-safe: yes.
RenderMaterial material_of(const RenderModel& model, const RenderObject& object, std::uint32_t triangle,
                           const Eigen::Vector3d& barycentric) noexcept;

// Where a point of a triangle lies in its texture.
struct TexturePlace {
  const RenderTexture* texture = nullptr;  // null: none there
  Eigen::Vector2d xy_m = Eigen::Vector2d::Zero();
  Eigen::Vector3d x_gradient = Eigen::Vector3d::Zero();  // in the scene's world, within the triangle's plane
  Eigen::Vector3d y_gradient = Eigen::Vector3d::Zero();
  double fade = 1.0;
};

// Realtime-safe: yes.
TexturePlace texture_place(const RenderModel& model, const RenderObject& object, std::uint32_t triangle,
                           const Eigen::Vector3d& barycentric) noexcept;

// A point of a triangle in the scene's world.
inline Eigen::Vector3d place_world_m(const RenderObject& object, std::uint32_t triangle,
                                     const Eigen::Vector3d& barycentric) {
  const Triangle& t = object.mesh.triangles[triangle];
  return object.T_world_mesh *
         (barycentric[0] * object.mesh.vertices_m[t[0]] + barycentric[1] * object.mesh.vertices_m[t[1]] +
          barycentric[2] * object.mesh.vertices_m[t[2]]);
}

}  // namespace asperity
