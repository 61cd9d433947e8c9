#include "asperity/render/render_step.h"

#include <algorithm>
#include <cmath>

#include "asperity/base/smoothstep.h"
#include "asperity/render/proxy_state.h"
#include "asperity/render/render_model.h"
#include "asperity/render/texture_force.h"
#include "evaluate_contacts.h"
#include "follow_moving_objects.h"
#include "friction.h"
#include "move_proxy.h"
#include "start_proxy.h"
#include "touch_texture.h"

namespace asperity {
namespace {

// Begins a step of `dt_s`. Where the model's materials are others than in the step before and something was touched
// then, what was felt begins to ease towards the new over the textures' cross_fade_s. Without touch nothing eases.
// Realtime-safe: yes.
void ease_material(const RenderModel& model, double dt_s, EasedMaterial& eased) noexcept {
  const double over_s = model.config.texture.cross_fade_s;
  const bool is_changed = model.material_id != eased.id;
  eased.id = model.material_id;
  if (!eased.had_contact || !(over_s > 0.0)) {
    eased.left = 0.0;
  } else if (is_changed) {
    eased.from = eased.last;
    eased.since_s = 0.0;
    eased.left = 1.0;
  } else if (eased.left > 0.0) {
    eased.since_s += std::max(dt_s, 0.0);
    eased.left = 1.0 - smoothstep(eased.since_s / over_s);
  }
}

using Eigen::Vector3d;

bool is_finite(const DeviceState& device) {
  return device.p_world_m.allFinite() && device.v_world_mps.allFinite() && std::isfinite(device.dt_s);
}

Friction friction_of(const ContactState& contact, double texture_N) {
  return {std::max(contact.contact_N.norm() + texture_N, 0.0), contact.friction,
          contact.friction * contact.static_friction_ratio, contact.stiffness_N_per_m};
}

// Along which forces act: the contacts' own normal, or the interpolated one (Morgenbesser and Srinivasan 1996).
Vector3d shaded_normal(const RenderModel& model, const ProxyState& proxy, const ContactState& contact) {
  if (!model.config.force_shading) return contact.normal;
  Vector3d sum = Vector3d::Zero();
  for (std::size_t k = 0; k < proxy.touch_count; ++k) {
    const ProxyTouch& touch = proxy.touches[k];
    const RenderObject& object = model.objects[touch.object];
    if (object.corner_normals.empty()) return contact.normal;
    const auto& corners = object.corner_normals[touch.triangle];
    const Vector3d normal =
        object.T_world_mesh.rotation * Vector3d(touch.barycentric[0] * corners[0] + touch.barycentric[1] * corners[1] +
                                                touch.barycentric[2] * corners[2]);
    const double length = normal.norm();
    if (!(length > 0.0)) return contact.normal;
    sum += (contact.weights[k] * (normal.dot(touch.normal_world) < 0.0 ? -1.0 : 1.0) / length) * normal;
  }
  const double length = sum.norm();
  return length > 0.0 ? Vector3d(sum / length) : contact.normal;
}

SurfaceContact strongest_contact(const RenderModel& model, const ProxyState& proxy, const ContactState& contact) {
  if (proxy.touch_count == 0) return {};
  std::size_t k = 0;
  for (std::size_t i = 1; i < proxy.touch_count; ++i)
    if (contact.weights[i] > contact.weights[k]) k = i;
  const ProxyTouch& touch = proxy.touches[k];
  return {touch.object,       touch.triangle,
          touch.barycentric,  place_world_m(model.objects[touch.object], touch.triangle, touch.barycentric),
          touch.normal_world, contact.weights[k]};
}

}  // namespace

ServoOutput render_step(const RenderModel& model, ServoState& state, const DeviceState& device) noexcept {
  ServoOutput out;
  ProxyState& proxy = state.proxy;
  const Vector3d& p_m = device.p_world_m;
  const double stride_m = proxy.started ? (p_m - proxy.device_world_m).norm() : 0.0;
  proxy.work = 0;
  // A place so far away that its square is not a number is as bad as one that is none.
  if (!is_finite(device) || !std::isfinite(p_m.squaredNorm()) || !std::isfinite(stride_m)) {
    out.proxy_m = proxy.p_world_m;
    return out;
  }
  const double skin_m = kSkin * model.extent_m;
  const ProxyBall ball{model.config.tip_radius_m + skin_m, 0x1p-12 * skin_m, 0x1p-8 * model.extent_m, stride_m, skin_m};
  if (!start_proxy(model, ball, p_m, proxy)) {
    no_texture_force(state.texture, false, device.dt_s);
    out.proxy_m = p_m;
    out.starts_inside = true;
    return out;
  }
  follow_moving_objects(model, ball, proxy);
  ease_material(model, device.dt_s, proxy.material);

  // Friction holds the proxy back: its goal is not the device but a point that it lags behind by what friction bears.
  const Vector3d before_m = proxy.p_world_m;
  const ContactState held = evaluate_contacts(model, proxy, skin_m, p_m);
  const Friction holding = friction_of(held, proxy.texture_load_N);
  proxy.sticking = sticks(holding, proxy.sticking, held.rest_m);
  const bool rests = proxy.sticking && held.depth_m() > 0.0;
  bool arrived = true;
  if (!rests) {
    const Vector3d lag_m = proxy.sticking ? held.rest_m : sliding_lag_m(holding, held.rest_m);
    arrived = move_proxy(model, ball, p_m + lag_m, kAllObjects, proxy);
  }
  ContactState contact = evaluate_contacts(model, proxy, skin_m, p_m);
  if (!rests && !proxy.sticking && proxy.touch_count > 0 && !(contact.depth_m() > 0.0)) {
    // It has slid to where nothing presses it: nothing holds it back either.
    arrived = move_proxy(model, ball, p_m, kAllObjects, proxy);
    contact = evaluate_contacts(model, proxy, skin_m, p_m);
  }
  const bool is_free = proxy.touch_count == 0 && arrived;
  if (proxy.touch_count == 0) {
    find_texture_below(model, ball, proxy);
    if (proxy.over_texture) contact = evaluate_contacts(model, proxy, skin_m, p_m);
  }
  const Vector3d normal = shaded_normal(model, proxy, contact);
  out.contact_N = model.config.force_shading ? Vector3d(contact.contact_N.norm() * normal) : contact.contact_N;
  const Vector3d v_proxy_mps =
      device.dt_s > 0.0 ? Vector3d((proxy.p_world_m - before_m) / device.dt_s) : Vector3d::Zero();
  const TextureForce texture = touch_texture(model, proxy, contact, normal, v_proxy_mps, device, state.texture);
  out.texture_N = texture.force_N;
  out.texture_height_m = texture.height_m;
  proxy.texture_load_N = normal.dot(texture.force_N);
  out.friction_N =
      friction_force_N(friction_of(contact, proxy.texture_load_N), proxy.sticking, contact.rest_m, holding.load_N);
  out.force_N = out.contact_N + out.texture_N + out.friction_N;
  // Over a texture friction holds the proxy back as well.
  out.proxy_m = is_free && !(proxy.over_texture && holding.load_N > 0.0) ? p_m : contact.proxy_m;
  out.contact = strongest_contact(model, proxy, contact);
  out.sticking = proxy.sticking;
  proxy.material.had_contact = proxy.touch_count > 0;
  proxy.material.last = {contact.stiffness_N_per_m, contact.compliance_kc, contact.friction,
                         contact.static_friction_ratio};
  proxy.device_world_m = p_m;
  return out;
}

}  // namespace asperity
