#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>

#include "asperity/scene/scene.h"

namespace asperity::feel_test {

inline constexpr double kPitch_mm = 2.5, kAmplitude_m = 0.1e-3;

// A plate of 80 × 20 mm, its face at z = 0 of the mesh, textured all over: x along it from 0, y = 0 in its middle. The
// texture is a cosine of 2.5 mm, as a series that repeats after `length_mm`.
inline Scene plate(double length_mm) {
  constexpr std::uint32_t kAlong = 40, kAcross = 10;
  SceneObject object;
  object.mesh_file = "plate.obj";
  for (std::uint32_t j = 0; j <= kAcross; ++j) {
    for (std::uint32_t i = 0; i <= kAlong; ++i) object.mesh.vertices.emplace_back(2e-3 * i, 2e-3 * j, 0.0);
  }
  const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    HapticTriangle haptic;
    haptic.texture = 1;
    object.mesh.triangles.push_back({a, b, c});
    std::size_t k = 0;
    for (const std::uint32_t v : {a, b, c}) {
      const Eigen::Vector3d& p_m = object.mesh.vertices[v];
      haptic.xy_mm[k++] = {1e3 * p_m.x(), 1e3 * p_m.y() - 10.0};
    }
    object.mesh.haptic.push_back(haptic);
  };
  for (std::uint32_t j = 0; j < kAcross; ++j) {
    for (std::uint32_t i = 0; i < kAlong; ++i) {
      const std::uint32_t a = j * (kAlong + 1) + i, above = a + kAlong + 1;
      add(a, a + 1, above + 1);
      add(a, above + 1, above);
    }
  }
  Fourier1d series;
  series.length_mm = length_mm;
  const auto harmonics = static_cast<std::size_t>(std::lround(length_mm / kPitch_mm));
  series.a_m.assign(harmonics, 0.0);
  series.b_m.assign(harmonics, 0.0);
  series.a_m.back() = kAmplitude_m;
  Texture texture;
  texture.name = "wave";
  texture.model = series;
  texture.compliance_kc = 1.0;
  object.textures.push_back({1, "wave.texture.json", std::move(texture)});
  Scene scene;
  scene.objects.push_back(std::move(object));
  return scene;
}

inline double wave_m(double x_m) { return kAmplitude_m * std::cos(2.0 * std::numbers::pi * x_m * 1e3 / kPitch_mm); }

}  // namespace asperity::feel_test
