#include "render_cases.h"

#include <cmath>

#include "asperity/base/random.h"
#include "asperity/texture/fourier1d.h"

namespace bench {

asperity::Scene scene_of(const asperity::TriangleMesh& mesh, bool textured) {
  asperity::Scene scene;
  scene.objects.emplace_back();
  asperity::SceneObject& object = scene.objects.back();
  object.mesh_file = "bumpy_sphere.ply";
  object.mesh.vertices = mesh.vertices_m;
  object.mesh.triangles = mesh.triangles;
  if (!textured) return scene;

  constexpr int kHarmonics = 128;
  constexpr double kRms_m = 0.1e-3;
  asperity::Fourier1d series;
  asperity::Random random(1);
  double power = 0.0;
  for (int j = 1; j <= kHarmonics; ++j) {
    series.a_m.push_back(random.normal() / j);
    series.b_m.push_back(random.normal() / j);
    power += 0.5 * (series.a_m.back() * series.a_m.back() + series.b_m.back() * series.b_m.back());
  }
  for (double& a : series.a_m) a *= kRms_m / std::sqrt(power);
  for (double& b : series.b_m) b *= kRms_m / std::sqrt(power);
  asperity::Texture texture;
  texture.name = "fourier128";
  texture.model = series;
  object.textures.push_back({1, "fourier128.texture.json", texture});
  for (const asperity::Triangle& triangle : mesh.triangles) {
    asperity::HapticTriangle haptic;
    haptic.texture = 1;
    for (std::size_t k = 0; k < 3; ++k) haptic.xy_mm[k] = 1e3 * mesh.vertices_m[triangle[k]].head<2>();
    object.mesh.haptic.push_back(haptic);
  }
  return scene;
}

asperity::RenderConfig config_of(double tip_m, bool friction) {
  asperity::RenderConfig config;
  config.tip_radius_m = tip_m;
  config.stiffness_N_per_m = kStiffness_N_per_m;
  config.friction = friction ? kFriction : 0.0;
  config.static_friction_ratio = kStaticRatio;
  return config;
}

}  // namespace bench
