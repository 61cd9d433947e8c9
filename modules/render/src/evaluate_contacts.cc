#include "evaluate_contacts.h"

#include <Eigen/Geometry>

#include "project_on_planes.h"
#include "texture_border.h"

namespace asperity {

using Eigen::Vector2d;
using Eigen::Vector3d;

namespace {

// A vector split by the normals of touched surfaces: a part that they push (in the cone of the normals) and the rest,
// which is perpendicular to it (Moreau 1962). shares_m[i] >= 0: pushed = sum of shares_m[i] n_i.
struct ConeSplit {
  Eigen::Vector3d pushed_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d rest_m = Eigen::Vector3d::Zero();
  std::array<double, 3> shares_m{};
};

// At most three unit normals.
ConeSplit split_by_cone(const Vector3d& v_m, const std::array<Vector3d, 3>& normals, int count) noexcept {
  ConeSplit out;
  if (count == 1) {
    const double along_m = normals[0].dot(v_m);
    out.shares_m[0] = along_m > 0.0 ? along_m : 0.0;
    out.pushed_m = out.shares_m[0] * normals[0];
    out.rest_m = v_m - out.pushed_m;
    return out;
  }
  // The rest is the point nearest to v of the polar cone, n_i · x <= 0.
  PlaneProjection projection(v_m);
  for (int round = 0; round < 12; ++round) {
    int worst = -1;
    double worst_m = 0x1p-44 * v_m.norm();
    for (int i = 0; i < count; ++i) {
      const double out_m = normals[static_cast<std::size_t>(i)].dot(projection.x_m());
      if (out_m > worst_m) worst = i, worst_m = out_m;
    }
    if (worst < 0 || !projection.add({-normals[static_cast<std::size_t>(worst)], 0.0}, worst)) break;
  }
  for (int k = 0; k < projection.size(); ++k) {
    const auto& active = projection.active(k);
    out.shares_m[static_cast<std::size_t>(active.tag)] = active.multiplier_m;
    out.pushed_m -= active.multiplier_m * active.plane.normal;
  }
  out.rest_m = v_m - out.pushed_m;
  return out;
}

// The shortest y with n_i · y = 1 for all normals: one skin's thickness off all of them. No longer than 16, however
// acute the corner that they form.
Vector3d skin_offset(const std::array<Vector3d, 3>& normals, int count) noexcept {
  constexpr double kLongest = 16.0;
  Vector3d y = Vector3d::Zero();
  if (count == 1) {
    y = normals[0];
  } else if (count == 2) {
    const Vector3d sum = normals[0] + normals[1];  // n_i · sum = 1 + n_0 · n_1
    y = sum * (2.0 / sum.squaredNorm());
  } else if (count == 3) {
    const Vector3d m = normals[0].cross(normals[1]);
    y = (m + normals[1].cross(normals[2]) + normals[2].cross(normals[0])) / m.dot(normals[2]);
  }
  const double length = y.norm();
  if (!(length <= kLongest)) y = y.allFinite() ? Vector3d(y * (kLongest / length)) : normals[0];
  return y;
}

RenderMaterial mean_of(const RenderObject& object, const std::array<std::uint32_t, 3>& corners,
                       const Vector3d& barycentric) {
  RenderMaterial out{0.0, 0.0, 0.0, 0.0};
  for (std::size_t k = 0; k < 3; ++k) {
    const RenderMaterial& corner = object.materials[corners[k]];
    const double weight = barycentric[static_cast<Eigen::Index>(k)];
    out.stiffness_N_per_m += weight * corner.stiffness_N_per_m;
    out.compliance_kc += weight * corner.compliance_kc;
    out.friction += weight * corner.friction;
    out.static_friction_ratio += weight * corner.static_friction_ratio;
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

// The material at a point of an object's triangle, interpolated over its corners. What a texture brings fades towards
// the texture's border as its heights do: there the material is that without texture.
RenderMaterial material_of(const RenderModel& model, const RenderObject& object, std::uint32_t triangle,
                           const Vector3d& barycentric) noexcept {
  if (object.corner_material.empty()) return object.materials[0];
  const RenderMaterial own = mean_of(object, object.corner_material[triangle], barycentric);
  if (object.bare_material.empty() || object.bare_material[triangle] == object.corner_material[triangle]) return own;
  const double fade = fade_at(model, object, triangle, barycentric);
  return fade < 1.0 ? between(mean_of(object, object.bare_material[triangle], barycentric), own, fade) : own;
}

}  // namespace

ContactState evaluate_contacts(const RenderModel& model, const ProxyState& proxy, double skin_m,
                               const Vector3d& device_m) noexcept {
  ContactState state;
  state.proxy_m = proxy.p_world_m;
  const std::size_t count = proxy.touch_count;
  if (count == 0) return state;

  std::array<Vector3d, 3> normals;
  for (std::size_t k = 0; k < count; ++k) normals[k] = proxy.touches[k].normal_world;
  ConeSplit split;
  if (!proxy.over_texture) {
    state.proxy_m -= skin_m * skin_offset(normals, static_cast<int>(count));
    split = split_by_cone(state.proxy_m - device_m, normals, static_cast<int>(count));
  }
  double sum_m = 0.0;
  for (std::size_t k = 0; k < count; ++k) sum_m += split.shares_m[k];
  if (sum_m > 0.0) {
    state.pushed_m = split.pushed_m;
    state.rest_m = split.rest_m;
    state.normal = split.pushed_m.normalized();
  } else {
    const Vector3d u = state.proxy_m - device_m;
    state.normal = normals[0];
    state.rest_m = u - normals[0] * normals[0].dot(u);
  }

  state.compliance_kc = 0.0;
  double sum_N = 0.0;
  for (std::size_t k = 0; k < count; ++k) {
    const ProxyTouch& touch = proxy.touches[k];
    const double share = sum_m > 0.0 ? split.shares_m[k] / sum_m : (k == 0 ? 1.0 : 0.0);
    if (!(share > 0.0)) continue;
    RenderMaterial material = material_of(model, model.objects[touch.object], touch.triangle, touch.barycentric);
    if (proxy.material.left > 0.0) material = between(material, proxy.material.from, proxy.material.left);
    state.weights[k] = material.stiffness_N_per_m * (sum_m > 0.0 ? split.shares_m[k] : 1.0);
    sum_N += state.weights[k];
    if (sum_m > 0.0) state.contact_N += state.weights[k] * normals[k];
    state.stiffness_N_per_m += share * material.stiffness_N_per_m;
    state.compliance_kc += share * material.compliance_kc;
    state.friction += share * material.friction;
    state.static_friction_ratio += share * material.static_friction_ratio;
  }
  // Where nothing has stiffness the touches share by depth.
  for (std::size_t k = 0; k < count; ++k) {
    if (sum_N > 0.0)
      state.weights[k] /= sum_N;
    else
      state.weights[k] = sum_m > 0.0 ? split.shares_m[k] / sum_m : (k == 0 ? 1.0 : 0.0);
  }
  return state;
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
