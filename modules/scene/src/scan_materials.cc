#include "asperity/scene/scan_materials.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace asperity {

namespace {

Material measured_material(const Texture& texture) {
  constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
  return {texture.compliance_kc.value_or(kUnknown), texture.stiffness_N_per_m.value_or(kUnknown),
          texture.friction.value_or(kUnknown), texture.static_friction_ratio.value_or(kUnknown)};
}

bool is_measured(const Material& material) {
  return std::isfinite(material.compliance_kc) || std::isfinite(material.stiffness_N_per_m) ||
         std::isfinite(material.friction) || std::isfinite(material.static_friction_ratio);
}

bool same_number(double a, double b) { return a == b || (std::isnan(a) && std::isnan(b)); }

}  // namespace

MaterialMap scan_materials(const SceneObject& object) {
  std::vector<int> textures;
  std::vector<Material> materials;
  bool any = false;
  for (const SceneTexture& texture : object.textures) {
    if (!texture.origin || !texture.origin->is_scan()) continue;
    textures.push_back(texture.index);
    materials.push_back(measured_material(texture.texture));
    any = any || is_measured(materials.back());
  }
  if (!any || object.mesh.haptic.size() != object.mesh.triangles.size()) return {};
  const auto is_scan = [&](int index) { return std::find(textures.begin(), textures.end(), index) != textures.end(); };
  std::vector<HapticTriangle> highest(object.mesh.haptic.size());
  for (const CoveredTriangle& one : object.covered) {
    if (is_scan(one.haptic.texture)) highest[one.triangle] = one.haptic;
  }
  for (std::size_t t = 0; t < highest.size(); ++t) {
    if (is_scan(object.mesh.haptic[t].texture)) highest[t] = object.mesh.haptic[t];
  }
  return spread_materials(object.mesh.vertices.size(), object.mesh.triangles, highest, textures, materials);
}

bool is_of_scans(const SceneObject& object) {
  const MaterialMap measured = scan_materials(object);
  const std::vector<Material>&a = object.material.vertices, &b = measured.vertices;
  if (a.empty() || b.empty()) return a.empty() && b.empty();
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const Material& x, const Material& y) {
    return same_number(x.compliance_kc, y.compliance_kc) && same_number(x.stiffness_N_per_m, y.stiffness_N_per_m) &&
           same_number(x.friction, y.friction) && same_number(x.static_friction_ratio, y.static_friction_ratio);
  });
}

void set_scan_materials(SceneObject& object, const std::string& file) {
  object.material = scan_materials(object);
  if (object.material.vertices.empty()) {
    object.material_file.clear();
  } else if (object.material_file.empty()) {
    object.material_file = file;
  }
}

}  // namespace asperity
