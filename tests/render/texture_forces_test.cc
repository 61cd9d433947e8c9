// Equations (3) to (6) of the seed's §6.5 with errata 19 and 20, computed by hand for a Fourier texture on a plane.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "asperity/base/random.h"
#include "asperity/texture/fourier1d.h"
#include "render_rig.h"

namespace asperity::render_test {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

// A table of heights is within 1e-6 of their RMS, about 0.1 mm: 0.1 µN at 1 N/mm. The lowest is known to 1 µN here.
constexpr double kForceTol_N = 3e-6;

Fourier1d some_texture() {
  Fourier1d texture;
  texture.length_mm = 10.0;
  Random random(31);
  for (int j = 1; j <= 128; ++j) {
    texture.a_m.push_back(50e-6 * random.normal() / j);
    texture.b_m.push_back(50e-6 * random.normal() / j);
  }
  texture.mean_m = 17e-6;
  return texture;
}

double series_m(const Fourier1d& texture, double x_mm) {
  double sum_m = texture.mean_m;
  for (std::size_t k = 0; k < texture.a_m.size(); ++k) {
    const double phase = 2.0 * std::numbers::pi / texture.length_mm * static_cast<double>(k + 1) * x_mm;
    sum_m += texture.a_m[k] * std::cos(phase) + texture.b_m[k] * std::sin(phase);
  }
  return sum_m;
}

// Erratum 20: the lowest point lies on the surface. On a grid of 0.5 µm the lowest is found to 1 nm.
double lowest_m(const Fourier1d& texture) {
  double lowest = texture.mean_m;
  for (int i = 0; i < 20000; ++i) lowest = std::min(lowest, series_m(texture, 5e-4 * i));
  return lowest;
}

// A sheet with the texture where x is below `until_m`, x along the scan path.
Scene textured_sheet(const Texture& texture, double until_m = 1.0) {
  Scene scene = scene_of({sheet(40e-3, 40, 0.0)});
  SceneObject& object = scene.objects[0];
  object.textures.push_back({1, "some.texture.json", texture});
  for (const Triangle& triangle : object.mesh.triangles) {
    HapticTriangle haptic;
    double right_m = -1.0;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vector3d& p = object.mesh.vertices[triangle[k]];
      haptic.xy_mm[k] = Vector2d(1e3 * p.x(), 1e3 * p.y());
      right_m = std::max(right_m, p.x());
    }
    if (right_m <= until_m) haptic.texture = 1;
    object.mesh.haptic.push_back(haptic);
  }
  return scene;
}

struct Expected {
  double contact_N, texture_N, height_m;
};

Expected by_hand(const Fourier1d& texture, double lowest, double x_m, double z_m, double k_N_per_m, double kc) {
  const double height_m = series_m(texture, 1e3 * x_m) - lowest;
  const double depth_m = std::max(-z_m, 0.0);
  const double into_m = std::clamp(height_m - z_m, 0.0, height_m);
  return {k_N_per_m * depth_m, kc * k_N_per_m * into_m, height_m};
}

class TextureForces : public OfTipRadii {};
INSTANTIATE_TEST_SUITE_P(Radii, TextureForces, testing::Values(0.0, 0.5e-3));

TEST_P(TextureForces, FollowTheFormulaAlongAStroke) {
  const Fourier1d series = some_texture();
  const double lowest = lowest_m(series);
  for (const bool own : {false, true}) {
    Texture texture;
    texture.name = "some";
    texture.model = series;
    if (own) {
      texture.compliance_kc = 0.7725;
      texture.stiffness_N_per_m = 500.0;
    }
    const double k_N_per_m = own ? 500.0 : 1000.0, kc = own ? 0.7725 : 1.0;
    Rig rig(textured_sheet(texture), config());
    rig.go({-15e-3, 1e-3, 5e-3});
    rig.go({-15e-3, 1e-3, radius_m() + 0.1e-3});
    // Rest until what fades in on the first touch is over.
    for (int k = 0; k < 200; ++k) rig.step({-15e-3, 1e-3, radius_m() + 0.1e-3});
    int only_texture = 0, both = 0;
    for (int k = 0; k < 5000; ++k) {
      const double x_m = -15e-3 + 5e-6 * k, z_m = 0.25e-3 * std::cos(0.013 * k) - 0.1e-3;
      const ServoOutput out = rig.step({x_m, 1e-3 + 1e-6 * k, radius_m() + z_m});
      if (k < 200) continue;
      const Expected expected = by_hand(series, lowest, x_m, z_m, k_N_per_m, kc);
      ASSERT_LE((out.contact_N - Vector3d(0, 0, expected.contact_N)).norm(), kForceTol_N) << k;
      ASSERT_LE((out.texture_N - Vector3d(0, 0, expected.texture_N)).norm(), kForceTol_N)
          << k << " z " << z_m << " got " << out.texture_N.transpose() << " expected " << expected.texture_N;
      ASSERT_LE(out.friction_N.norm(), 0.0);
      ASSERT_LE((out.force_N - out.contact_N - out.texture_N).norm(), 1e-12);
      if (expected.texture_N > 0.0) {
        ASSERT_NEAR(out.texture_height_m, expected.height_m, 2e-9);
      }
      only_texture += z_m > 0.0 && expected.texture_N > 0.0;
      both += z_m < 0.0;
    }
    EXPECT_GT(only_texture, 500);
    EXPECT_GT(both, 500);
  }
}

TEST_P(TextureForces, NothingAboveTheTexture) {
  Texture texture;
  texture.model = some_texture();
  Rig rig(textured_sheet(texture), config());
  rig.go({0, 0, radius_m() + 2e-3});
  for (int k = 0; k < 500; ++k) EXPECT_EQ(rig.step({1e-5 * k, 0, radius_m() + 1e-3}).force_N, Vector3d::Zero());
}

TEST_P(TextureForces, AreContinuousAtTheBorderOfTheirArea) {
  const Fourier1d series = some_texture();
  const double lowest = lowest_m(series);
  Texture texture;
  texture.model = series;
  RenderConfig fading = config();
  fading.border_fade_m = 1e-3;
  Rig rig(textured_sheet(texture, 0.5e-3), fading);  // textured where x <= 0
  double steepest = 0.0, highest_m = 0.0;
  for (int i = 0; i < 20000; ++i) {
    steepest = std::max(steepest, std::abs(series_m(series, 5e-4 * (i + 1)) - series_m(series, 5e-4 * i)) / 5e-7);
    highest_m = std::max(highest_m, series_m(series, 5e-4 * i) - lowest);
  }
  constexpr double kStep_m = 2e-6;
  rig.go({-5e-3, 0.3e-3, 3e-3});
  rig.go({-5e-3, 0.3e-3, radius_m() - 0.1e-3});
  for (int k = 0; k < 200; ++k) rig.step({-5e-3, 0.3e-3, radius_m() - 0.1e-3});
  ServoOutput before = rig.step({-5e-3, 0.3e-3, radius_m() - 0.1e-3});
  // A fade that is smooth may be twice as steep as a straight one.
  const double most_N = kStiffness_N_per_m * (steepest + 2.0 * highest_m / fading.border_fade_m) * kStep_m;
  for (double x_m = -5e-3 + kStep_m; x_m < 3e-3; x_m += kStep_m) {
    const ServoOutput out = rig.step({x_m, 0.3e-3, radius_m() - 0.1e-3});
    ASSERT_LE((out.texture_N - before.texture_N).norm(), most_N) << x_m;
    if (x_m < -1.5e-3) {
      ASSERT_NEAR(out.texture_N.z(), kStiffness_N_per_m * (series_m(series, 1e3 * x_m) - lowest), kForceTol_N);
    }
    if (x_m > 1e-3) {
      ASSERT_EQ(out.texture_N, Vector3d::Zero());
    }
    before = out;
  }
}

TEST_P(TextureForces, FrictionFollowsContactAndTexture) {
  const Fourier1d series = some_texture();
  Texture texture;
  texture.model = series;
  texture.friction = 0.4;
  RenderConfig rubbing = config();
  rubbing.friction = 0.9;  // the texture knows better
  Rig rig(textured_sheet(texture), rubbing);
  rig.go({-15e-3, 1e-3, 5e-3});
  rig.go({-15e-3, 1e-3, radius_m() - 0.3e-3});
  for (int k = 0; k < 6000; ++k) {
    const ServoOutput out = rig.step({-15e-3 + 5e-6 * k, 1e-3, radius_m() - 0.3e-3});
    const double normal_N = (out.contact_N + out.texture_N).norm();
    ASSERT_LE(out.friction_N.norm(), 1.2 * 0.4 * normal_N * (1.0 + 1e-6)) << k;
    ASSERT_NEAR(out.contact_N.z(), 0.3, 1e-6);
    if (k > 1000) {
      ASSERT_LT(out.friction_N.x(), 0.0);
    }
    if (k > 1000 && !out.sticking) {
      ASSERT_NEAR(out.friction_N.norm(), 0.4 * normal_N, 0.02) << k;
    }
  }
}

}  // namespace
}  // namespace asperity::render_test
