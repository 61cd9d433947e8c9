#include "touch_texture.h"

#include <algorithm>
#include <cmath>

#include "triangle_foot.h"

namespace asperity {

using Eigen::Vector3d;

void find_texture_below(const RenderModel& model, const ProxyBall& ball, ProxyState& proxy) noexcept {
  proxy.over_texture = false;
  proxy.texture_hidden = false;
  proxy.touch_count = 0;
  if (!(model.highest_m > 0.0)) return;
  ensure_triangles_within(model, ball, ball.radius_m + model.highest_m, kAllObjects, proxy);
  double nearest_m = ball.radius_m + model.highest_m;
  for (std::uint32_t i = 0; i < proxy.near.count; ++i) {
    const NearTriangle& t = proxy.near.triangles[i];
    const double height_m = t.normal.dot(proxy.p_world_m - t.a_m);
    if (!(std::abs(height_m) < nearest_m)) continue;
    const TriangleFoot foot = foot_on(t, proxy.p_world_m);
    if (!(foot.distance_m < nearest_m)) continue;
    nearest_m = foot.distance_m;
    const Vector3d normal =
        foot.inside() ? Vector3d((height_m < 0.0 ? -1.0 : 1.0) * t.normal) : Vector3d(foot.from_m / foot.distance_m);
    proxy.touches[0] = {t.object, t.triangle, foot.barycentric, normal, 0.0};
    proxy.touch_count = 1;
  }
  if (proxy.touch_count == 0) return;
  const RenderObject& object = model.objects[proxy.touches[0].object];
  proxy.over_texture = !object.texture.empty() && object.texture[proxy.touches[0].triangle] >= 0;
  proxy.texture_hidden = !proxy.over_texture;
  if (!proxy.over_texture) proxy.touch_count = 0;
}

TextureForce touch_texture(const RenderModel& model, const ProxyState& proxy, const ContactState& contact,
                           const Vector3d& normal, const Vector3d& v_proxy_mps, const DeviceState& device,
                           TextureState& state) noexcept {
  // What hides a texture may do so in one step: as a surface without one it lets the force fade, in and out.
  if (proxy.touch_count == 0) return no_texture_force(state, proxy.texture_hidden, device.dt_s);
  std::size_t strongest = 0;
  for (std::size_t k = 1; k < proxy.touch_count; ++k)
    if (contact.weights[k] > contact.weights[strongest]) strongest = k;
  const ProxyTouch& at = proxy.touches[strongest];
  const RenderObject& object = model.objects[at.object];
  const TexturePlace place = texture_place(model, object, at.triangle, at.barycentric);
  if (place.texture == nullptr) return no_texture_force(state, true, device.dt_s);

  TextureTouch touch;
  touch.x_m = place.xy_m.x();
  touch.y_m = place.xy_m.y();
  // The force's normal may be another than the triangle's (shaded, of an edge, of several touches): a slope is across
  // it.
  touch.x_gradient = place.x_gradient - normal * normal.dot(place.x_gradient);
  touch.y_gradient = place.y_gradient - normal * normal.dot(place.y_gradient);
  touch.normal = normal;
  touch.z_m = -contact.depth_m();
  if (!(contact.depth_m() > 0.0)) {
    const Vector3d foot_m = place_world_m(object, at.triangle, at.barycentric);
    touch.z_m = std::max(at.normal_world.dot(device.p_world_m - foot_m) - model.config.tip_radius_m, 0.0);
  }
  touch.contact_N = contact.contact_N.norm();
  touch.v_tangential_mps = v_proxy_mps - normal * normal.dot(v_proxy_mps);
  touch.approach_mps = std::max(-normal.dot(device.v_world_mps), 0.0);
  touch.stiffness_N_per_m = contact.stiffness_N_per_m;
  touch.compliance_kc = contact.compliance_kc;
  touch.fade = place.fade;
  touch.dt_s = device.dt_s;
  return texture_force(*place.texture, state, touch);
}

}  // namespace asperity
