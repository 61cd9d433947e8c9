#include "asperity/render/render_step.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "asperity/render/texture_force.h"
#include "move_proxy.h"
#include "start_proxy.h"
#include "surface_place.h"
#include "touch_frame.h"
#include "triangle_foot.h"

namespace asperity {
namespace {

using Eigen::Vector3d;

// What the hand feels of the surfaces that the proxy touches.
struct Feel {
  Vector3d proxy_m = Vector3d::Zero();  // without the skin
  std::array<Vector3d, 3> normals;
  int count = 0;
  ConeSplit split;                 // of proxy - device
  double stiffness_N_per_m = 0.0;  // mean by the shares
  double friction = 0.0;
  double static_friction = 0.0;
  Vector3d contact_N = Vector3d::Zero();
  std::array<double, 3> weights{};
};

Feel feel_touches(const RenderModel& model, const ProxyState& proxy, double skin_m, const Vector3d& p_m) {
  Feel feel;
  feel.count = static_cast<int>(proxy.touch_count);
  for (std::size_t k = 0; k < proxy.touch_count; ++k) feel.normals[k] = proxy.touches[k].normal_world;
  feel.proxy_m = proxy.p_world_m;
  if (feel.count == 0) return feel;
  if (!proxy.over_texture) feel.proxy_m -= skin_m * off_all(feel.normals, feel.count);
  const Vector3d u = feel.proxy_m - p_m;
  if (!proxy.over_texture) feel.split = split_by_cone(u, feel.normals, feel.count);
  double sum_m = 0.0, force_N = 0.0;
  for (std::size_t k = 0; k < proxy.touch_count; ++k) sum_m += feel.split.shares_m[k];
  if (!(sum_m > 0.0)) feel.split.rest_m = u - feel.normals[0] * feel.normals[0].dot(u);
  for (std::size_t k = 0; k < proxy.touch_count; ++k) {
    const ProxyTouch& touch = proxy.touches[k];
    const RenderMaterial material = material_of(model.objects[touch.object], touch.triangle, touch.barycentric);
    const double share = sum_m > 0.0 ? feel.split.shares_m[k] / sum_m : (k == 0 ? 1.0 : 0.0);
    feel.weights[k] = material.stiffness_N_per_m * feel.split.shares_m[k];
    force_N += feel.weights[k];
    feel.contact_N += feel.weights[k] * feel.normals[k];
    feel.stiffness_N_per_m += share * material.stiffness_N_per_m;
    feel.friction += share * material.friction;
  }
  for (std::size_t k = 0; k < proxy.touch_count; ++k)
    feel.weights[k] = force_N > 0.0 ? feel.weights[k] / force_N : (k == 0 ? 1.0 : 0.0);
  feel.static_friction = feel.friction * model.config.static_friction_ratio;
  return feel;
}

}  // namespace

ServoOutput render_step(const RenderModel& model, ServoState& state, const DeviceState& device) noexcept {
  ServoOutput out;
  ProxyState& proxy = state.proxy;
  const Vector3d& p_m = device.p_world_m;
  if (!p_m.allFinite() || !device.v_world_mps.allFinite() || !std::isfinite(device.dt_s)) {
    out.proxy_m = proxy.p_world_m;
    return out;
  }
  const double skin_m = 0x1p-20 * model.extent_m;
  const ProxyBall ball{model.config.tip_radius_m + skin_m, 0x1p-12 * skin_m, 0x1p-8 * model.extent_m};
  if (!start_proxy(model, ball, p_m, proxy)) {
    out.proxy_m = p_m;
    out.starts_inside = true;
    return out;
  }

  // Friction holds the proxy back from where the surfaces alone would let it go: by all of the way that leads along
  // them while it sticks, by what sliding friction can bear while it slips.
  Vector3d goal_m = p_m;
  bool stays = false;
  proxy.sticking = proxy.sticking && proxy.touch_count > 0;
  if (proxy.touch_count > 0) {
    const Feel feel = feel_touches(model, proxy, skin_m, p_m);
    const double load_N = feel.contact_N.norm() + proxy.texture_load_N;
    const double along_N = feel.stiffness_N_per_m * feel.split.rest_m.norm();
    const double holds_N = (proxy.sticking ? feel.static_friction : feel.friction) * load_N;
    const bool rubs = load_N > 0.0 && feel.friction > 0.0;
    proxy.sticking = rubs && along_N <= holds_N;
    if (proxy.sticking) {
      goal_m = p_m + feel.split.rest_m;
      stays = !proxy.over_texture && feel.contact_N != Vector3d::Zero();
    } else if (rubs) {
      goal_m = p_m + (feel.friction * load_N / along_N) * feel.split.rest_m;
    }
  }
  if (!stays) move_proxy(model, ball, goal_m, SurfaceContact::kNone, proxy);

  const Feel feel = feel_touches(model, proxy, skin_m, p_m);
  out.contact_N = feel.contact_N;
  const double load_N = feel.contact_N.norm();
  if (load_N > 0.0 && feel.friction > 0.0) {
    const double along_m = feel.split.rest_m.norm();
    const double along_N = feel.stiffness_N_per_m * along_m;
    const double bears_N = (proxy.sticking ? feel.static_friction : feel.friction) * load_N;
    if (along_N > 0.0) out.friction_N = (std::min(along_N, bears_N) / along_m) * feel.split.rest_m;
  }
  out.sticking = proxy.sticking;
  out.proxy_m = load_N > 0.0 ? feel.proxy_m : p_m;
  if (proxy.touch_count > 0) {
    const ProxyTouch& touch = proxy.touches[0];
    out.contact = {touch.object,       touch.triangle,
                   touch.barycentric,  place_world_m(model.objects[touch.object], touch.triangle, touch.barycentric),
                   touch.normal_world, feel.weights[0]};
  }
  out.force_N = out.contact_N + out.texture_N + out.friction_N;
  proxy.device_world_m = p_m;
  return out;
}

}  // namespace asperity
