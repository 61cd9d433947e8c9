#pragma once

#include <array>
#include <cstdint>

#include <Eigen/Core>

#include "asperity/geometry/pose.h"
#include "asperity/render/near_triangles.h"
#include "asperity/render/render_material.h"

namespace asperity {

// A contact of the proxy.
struct ProxyTouch {
  std::uint32_t object = 0;
  std::uint32_t triangle = 0;
  Eigen::Vector3d barycentric = Eigen::Vector3d::Zero();
  Eigen::Vector3d normal_world = Eigen::Vector3d::Zero();  // unit, from the surface towards the tip
  double pull_m = 0.0;  // multiplier: how far the surface holds the proxy off its goal along the normal
};

// What the proxy remembers of the material that it touches, so that an exchange of the snapshot under a touching tip
// does not step the force. Plain data.
struct EasedMaterial {
  std::uint64_t id = 0;      // RenderModel::material_id of the step before
  bool had_contact = false;  // in the step before: `last` is what was rendered
  RenderMaterial last;
  RenderMaterial from;   // the material rendered at the exchange
  double since_s = 0.0;  // time since then
  double left = 0.0;     // how much of `from` is still rendered: 1 at the exchange, 0 at its end and without one
};

// The proxy between two steps: where the tip's centre would be if objects were rigid.
struct ProxyState {
  static constexpr std::uint32_t kMostObjects = 64;

  bool started = false;
  bool starts_inside = false;  // the device was inside an object and has not left it yet: no force
  bool sticking = false;
  bool over_texture = false;                                 // the touch is with a texture above the surface alone
  bool texture_hidden = false;                               // nothing touches, and what is nearest has no texture
  Eigen::Vector3d p_world_m = Eigen::Vector3d::Zero();       // centre of the proxy with its skin (docs/render.md)
  Eigen::Vector3d device_world_m = Eigen::Vector3d::Zero();  // of the step before
  double texture_load_N = 0.0;  // of the texture along the normal (signed), in the step before
  std::uint32_t touch_count = 0;
  std::array<ProxyTouch, 3> touches;  // the strongest first
  EasedMaterial material;

  // The objects as they were in the step before.
  std::uint32_t object_count = 0;
  std::array<std::uint64_t, kMostObjects> object_id{};
  std::array<Pose, kMostObjects> T_world_mesh;

  std::int64_t work = 0;  // evaluations of triangles in the step: what bounds its time
  double reach_m = 0.0;   // how far round the proxy triangles were gathered last
  NearTriangles near;
};

}  // namespace asperity
