#include "feel_touches.h"

#include "surface_place.h"

namespace asperity {

using Eigen::Vector3d;

Feel feel_touches(const RenderModel& model, const ProxyState& proxy, double skin_m, const Vector3d& device_m) noexcept {
  Feel feel;
  feel.proxy_m = proxy.p_world_m;
  const std::size_t count = proxy.touch_count;
  if (count == 0) return feel;

  std::array<Vector3d, 3> normals;
  for (std::size_t k = 0; k < count; ++k) normals[k] = proxy.touches[k].normal_world;
  ConeSplit split;
  if (!proxy.over_texture) {
    feel.proxy_m -= skin_m * off_all(normals, static_cast<int>(count));
    split = split_by_cone(feel.proxy_m - device_m, normals, static_cast<int>(count));
  }
  double sum_m = 0.0;
  for (std::size_t k = 0; k < count; ++k) sum_m += split.shares_m[k];
  if (sum_m > 0.0) {
    feel.pushed_m = split.pushed_m;
    feel.rest_m = split.rest_m;
    feel.normal = split.pushed_m.normalized();
  } else {
    const Vector3d u = feel.proxy_m - device_m;
    feel.normal = normals[0];
    feel.rest_m = u - normals[0] * normals[0].dot(u);
  }

  feel.compliance_kc = 0.0;
  double sum_N = 0.0;
  for (std::size_t k = 0; k < count; ++k) {
    const ProxyTouch& touch = proxy.touches[k];
    const double share = sum_m > 0.0 ? split.shares_m[k] / sum_m : (k == 0 ? 1.0 : 0.0);
    if (!(share > 0.0)) continue;
    RenderMaterial material = material_of(model, model.objects[touch.object], touch.triangle, touch.barycentric);
    if (proxy.material.left > 0.0) material = between(material, proxy.material.from, proxy.material.left);
    feel.weights[k] = material.stiffness_N_per_m * (sum_m > 0.0 ? split.shares_m[k] : 1.0);
    sum_N += feel.weights[k];
    if (sum_m > 0.0) feel.contact_N += feel.weights[k] * normals[k];
    feel.stiffness_N_per_m += share * material.stiffness_N_per_m;
    feel.compliance_kc += share * material.compliance_kc;
    feel.friction += share * material.friction;
  }
  // Where nothing has stiffness the touches share by depth.
  for (std::size_t k = 0; k < count; ++k) {
    if (sum_N > 0.0)
      feel.weights[k] /= sum_N;
    else
      feel.weights[k] = sum_m > 0.0 ? split.shares_m[k] / sum_m : (k == 0 ? 1.0 : 0.0);
  }
  return feel;
}

}  // namespace asperity
