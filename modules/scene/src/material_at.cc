#include "asperity/scene/material_at.h"

#include <cmath>
#include <string>

#include "asperity/base/error.h"

namespace asperity {

namespace {

// Over the corners at which the property is known.
double interpolated(const SceneObject& object, const Triangle& triangle, const Eigen::Vector3d& barycentric,
                    double Material::*property) {
  double sum = 0.0, weight = 0.0;
  if (object.material.vertices.empty()) return std::numeric_limits<double>::quiet_NaN();
  for (std::size_t k = 0; k < 3; ++k) {
    const double value = object.material.vertices.at(triangle[k]).*property;
    if (!std::isfinite(value)) continue;
    sum += barycentric[static_cast<Eigen::Index>(k)] * value;
    weight += barycentric[static_cast<Eigen::Index>(k)];
  }
  return weight > 0.0 ? sum / weight : std::numeric_limits<double>::quiet_NaN();
}

double first_known(double a, const std::optional<double>& b, const std::optional<double>& c) {
  if (std::isfinite(a)) return a;
  return b ? *b : c.value_or(std::numeric_limits<double>::quiet_NaN());
}

}  // namespace

Material material_at(const Scene& scene, const SceneObject& object, std::uint32_t triangle,
                     const Eigen::Vector3d& barycentric) {
  if (triangle >= object.mesh.triangles.size()) {
    throw Error("material: triangle " + std::to_string(triangle) + " of " +
                std::to_string(object.mesh.triangles.size()));
  }
  const Triangle& corners = object.mesh.triangles[triangle];
  const SceneTexture* laid =
      object.mesh.haptic.empty() ? nullptr : object.find_texture(object.mesh.haptic[triangle].texture);
  const Texture none;
  const Texture& texture = laid == nullptr ? none : laid->texture;
  Material out;
  out.compliance_kc = first_known(interpolated(object, corners, barycentric, &Material::compliance_kc),
                                  texture.compliance_kc, std::nullopt);
  out.stiffness_N_per_m = first_known(interpolated(object, corners, barycentric, &Material::stiffness_N_per_m),
                                      texture.stiffness_N_per_m, scene.stiffness_N_per_m);
  out.friction =
      first_known(interpolated(object, corners, barycentric, &Material::friction), texture.friction, scene.friction);
  out.static_friction_ratio = first_known(interpolated(object, corners, barycentric, &Material::static_friction_ratio),
                                          texture.static_friction_ratio, scene.static_friction_ratio);
  return out;
}

}  // namespace asperity
