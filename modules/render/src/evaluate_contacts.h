#pragma once

#include <array>
#include <cstdint>

#include <Eigen/Core>

#include "asperity/render/proxy_state.h"
#include "asperity/render/render_model.h"

namespace asperity {

// How the hand is held by the surfaces that the proxy touches.
struct ContactState {
  Eigen::Vector3d proxy_m = Eigen::Vector3d::Zero();  // without the skin
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();   // unit: along the sum of the contacts; zero if nothing is touched
  Eigen::Vector3d pushed_m = Eigen::Vector3d::Zero();   // proxy - device: what the surfaces push, in the normals' cone
  Eigen::Vector3d rest_m = Eigen::Vector3d::Zero();     // and the rest, along the surfaces
  Eigen::Vector3d contact_N = Eigen::Vector3d::Zero();  // (4): stiffness times depth, for each surface by its own
  std::array<double, 3> weights{};                      // the touches' shares of it; sum 1 if anything is touched
  double stiffness_N_per_m = 0.0;                       // means by the shares
  double compliance_kc = 1.0;
  double friction = 0.0;
  double static_friction_ratio = 0.0;

  double depth_m() const { return pushed_m.norm(); }
};

// A proxy that touches without being pushed (the device is above the surface, by less than the skin or within a
// texture) has no contact force; the rest is then what is perpendicular to the strongest touch's normal.
ContactState evaluate_contacts(const RenderModel& model, const ProxyState& proxy, double skin_m,
                               const Eigen::Vector3d& device_m) noexcept;

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
