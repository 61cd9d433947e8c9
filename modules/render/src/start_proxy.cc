#include "start_proxy.h"

#include <array>
#include <cmath>

namespace asperity {
namespace {

using Eigen::Vector3d;

constexpr int kMostCrossings = 64;

// Skew to all that meshes are usually aligned with.
const std::array<Vector3d, 5> kDirections{Vector3d(0.5377, 0.8339, -0.2259), Vector3d(-0.8622, 0.3188, 0.6077),
                                          Vector3d(0.3426, -0.7578, 0.5669), Vector3d(-0.4336, -0.3077, -0.8650),
                                          Vector3d(0.7254, -0.1631, -0.7147)};

bool crosses_odd(const RenderObject& object, const Vector3d& p_mesh_m, const Vector3d& direction, double step_m) {
  bool odd = false;
  Vector3d origin_m = p_mesh_m;
  for (int k = 0; k < kMostCrossings; ++k) {
    const RayHit hit = object.bvh.cast_ray(origin_m, direction);
    if (!hit.found()) return odd;
    odd = !odd;
    origin_m += (hit.t + step_m) * direction;
  }
  return true;  // not known: inside is the side of no force
}

bool same_objects(const RenderModel& model, const ProxyState& proxy) {
  if (proxy.object_count != model.objects.size()) return false;
  for (std::size_t k = 0; k < model.objects.size(); ++k)
    if (proxy.object_id[k] != model.objects[k].id) return false;
  return true;
}

}  // namespace

bool is_inside(const RenderModel& model, const Vector3d& p_world_m) noexcept {
  for (const RenderObject& object : model.objects) {
    if (!object.closed) continue;
    const Vector3d p_mesh_m = object.T_world_mesh.inverse() * p_world_m;
    int votes = 0;
    for (const Vector3d& direction : kDirections)
      votes += crosses_odd(object, p_mesh_m, direction, 0x1p-36 * model.extent_m) ? 1 : 0;
    if (2 * votes > static_cast<int>(kDirections.size())) return true;
  }
  return false;
}

bool start_proxy(const RenderModel& model, const ProxyBall& ball, const Vector3d& p_world_m,
                 ProxyState& proxy) noexcept {
  if (proxy.started && same_objects(model, proxy)) return true;
  proxy.started = false;
  proxy.starts_inside = true;
  for (const RenderObject& object : model.objects) {
    const Vector3d p_mesh_m = object.T_world_mesh.inverse() * p_world_m;
    if (object.bvh.closest_point(p_mesh_m, ball.radius_m).found()) return false;
  }
  if (is_inside(model, p_world_m)) return false;
  proxy.started = true;
  proxy.starts_inside = false;
  proxy.sticking = false;
  proxy.over_texture = false;
  proxy.texture_hidden = false;
  proxy.p_world_m = p_world_m;
  proxy.device_world_m = p_world_m;
  proxy.texture_load_N = 0.0;
  proxy.touch_count = 0;
  proxy.near.radius_m = -1.0;
  proxy.material = {};
  proxy.object_count = static_cast<std::uint32_t>(model.objects.size());
  for (std::size_t k = 0; k < model.objects.size(); ++k) {
    proxy.object_id[k] = model.objects[k].id;
    proxy.T_world_mesh[k] = model.objects[k].T_world_mesh;
  }
  return true;
}

}  // namespace asperity
