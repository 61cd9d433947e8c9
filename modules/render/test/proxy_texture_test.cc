#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "asperity/testkit/shape_meshes.h"
#include "scenes.h"

namespace asperity {
namespace {

using Eigen::Vector3d;
using testing_render::at;
using testing_render::scene_of;
using testing_render::stroke;

constexpr double kStiffness = 1000.0;
constexpr double kHeight_m = 0.2e-3;  // amplitude of the wave
constexpr double kWave_mm = 5.0;

// A plane whose part x < `until_m` has a wave along x, 0 to 2 kHeight above the plane.
RenderModel wavy_plane(double until_m, double friction, double kc) {
  Scene scene = scene_of(testkit::plane_mesh({0.1, 0.1}, 40, 40));
  SceneTexture laid;
  laid.index = 3;
  Fourier1d wave;
  wave.length_mm = kWave_mm;
  wave.a_m = {kHeight_m};
  wave.b_m = {0.0};
  laid.texture.model = wave;
  laid.texture.height_offset_m = kHeight_m;
  laid.texture.compliance_kc = kc;
  scene.objects[0].textures.push_back(laid);
  MeshFile& mesh = scene.objects[0].mesh;
  for (const Triangle& t : mesh.triangles) {
    HapticTriangle haptic;
    double middle_m = 0.0;
    for (std::size_t k = 0; k < 3; ++k) {
      haptic.xy_mm[k] = 1e3 * mesh.vertices[t[k]].head<2>();
      middle_m += mesh.vertices[t[k]].x() / 3.0;
    }
    haptic.texture = middle_m < until_m ? 3 : -1;
    mesh.haptic.push_back(haptic);
  }
  RenderConfig config;
  config.friction = friction;
  return make_render_model(scene, config);
}

double wave_m(double x_m) { return kHeight_m * (1.0 + std::cos(2.0 * std::numbers::pi * x_m * 1e3 / kWave_mm)); }

TEST(ProxyTexture, IsFeltAboveAndBelowTheSurfaceAsInTheSeed) {
  const double kc = 0.7;
  const RenderModel model = wavy_plane(1.0, 0.0, kc);
  for (const double z_m : {0.5e-3, 0.3e-3, 0.1e-3, 0.0, -0.1e-3, -0.5e-3}) {
    ServoState state;
    stroke(model, state, {0.03, 0.05, 0.01}, {0.03, 0.05, z_m}, 1e-5);
    for (int k = 0; k < 500; ++k) {
      const double x_m = 0.03 + 2e-5 * k;
      const ServoOutput out = render_step(model, state, at({x_m, 0.05, z_m}));
      const double height_m = wave_m(x_m);
      const double d_m = std::max(-z_m, 0.0), dh_m = std::clamp(height_m - z_m, 0.0, height_m);
      ASSERT_NEAR(out.contact_N.z(), kStiffness * d_m, 1e-9);
      ASSERT_NEAR(out.texture_N.z(), kc * kStiffness * dh_m, 1e-4) << z_m << ' ' << k;  // table against cosine
      ASSERT_NEAR(out.force_N.head<2>().norm(), 0.0, 1e-7);  // the way to an edge is as exact as the skin is thick
      ASSERT_NEAR(out.texture_height_m, z_m < 2.0 * kHeight_m ? height_m : 0.0, 1e-7);
    }
  }
}

TEST(ProxyTexture, ForceIsContinuousOnTheWayInAndOverTheBorder) {
  const RenderModel model = wavy_plane(0.05, 0.0, 1.0);
  ServoState state;
  Vector3d before = Vector3d::Zero();
  const double step_m = 1e-6;
  render_step(model, state, at({0.03, 0.05, 1e-3}));
  for (int k = 0; k < 2000; ++k) {
    const ServoOutput out = render_step(model, state, at({0.03, 0.05, 1e-3 - step_m * k}));
    ASSERT_LT((out.force_N - before).norm(), 2.1 * kStiffness * step_m) << k;
    before = out.force_N;
  }
  stroke(model, state, {0.03, 0.05, -1e-3}, {0.045, 0.05, -1e-3}, 1e-5);
  before = render_step(model, state, at({0.045, 0.05, -1e-3})).force_N;
  const double slope = 2.0 * std::numbers::pi * kHeight_m / (kWave_mm * 1e-3) + 2.0 * kHeight_m * 1.5 / 1e-3;
  for (int k = 1; k < 10000; ++k) {
    const ServoOutput out = render_step(model, state, at({0.045 + step_m * k, 0.05, -1e-3}));
    ASSERT_LT((out.force_N - before).norm(), 1.01 * kStiffness * slope * step_m + 1e-6) << k;
    before = out.force_N;
  }
  EXPECT_NEAR(before.z(), 1.0, 1e-9);
}

TEST(ProxyTexture, FrictionTakesTheTextureAsLoad) {
  const RenderModel model = wavy_plane(1.0, 0.3, 1.0);
  for (const double z_m : {0.05e-3, -0.4e-3}) {  // touching only the texture; both
    ServoState state;
    stroke(model, state, {0.02, 0.05, 0.01}, {0.02, 0.05, z_m}, 1e-5);
    for (int k = 0; k < 3000; ++k) {
      const ServoOutput out = render_step(model, state, at({0.02 + 1e-5 * k, 0.05, z_m}));
      ASSERT_TRUE(out.force_N.allFinite());
      const double load_N = out.contact_N.z() + out.texture_N.z();
      ASSERT_LE(out.friction_N.norm(), 1.2 * 0.3 * load_N + 1e-9);
      if (k > 300 && !out.sticking && load_N > 0.05) {
        ASSERT_NEAR(out.friction_N.x(), -0.3 * load_N, 0.02 * load_N) << z_m << ' ' << k;
      }
    }
  }
}

// A random texture pulls as often as it pushes: both count in the load that friction bears.
TEST(ProxyTexture, PullsTakeLoadOffFriction) {
  RenderModel model = wavy_plane(1.0, 0.5, 1.0);
  Texture texture = model.textures[0].texture;
  RenderTextureConfig config;
  config.model = kForceModelOf<StochasticTexture>;
  model.textures[0] = make_render_texture(texture, config);
  std::get<StochasticTexture>(*model.textures[0].series_of_heights).offset_sigmas = 0.0;
  ServoState state;
  stroke(model, state, {0.03, 0.05, 0.01}, {0.03, 0.05, -0.3e-3}, 1e-5);
  int pulls = 0;
  for (int k = 0; k < 2000; ++k) {
    const ServoOutput out = render_step(model, state, at({0.03 + 2e-5 * k, 0.05, -0.3e-3}));
    pulls += out.texture_N.z() < 0.0;
    const double normal_N = std::max((out.contact_N + out.texture_N).z(), 0.0);
    const double bears = 0.5 * (out.sticking ? model.config.static_friction_ratio : 1.0);
    ASSERT_LE(out.friction_N.norm(), bears * normal_N + 1e-12) << k;
  }
  EXPECT_GT(pulls, 100);
}

// Above a textured floor, towards a bare wall of another object, and back: where the wall becomes nearer than the floor
// the texture is hidden in one step, but its force fades.
TEST(ProxyTexture, HiddenByABareSurfaceFadesAndDoesNotClick) {
  Scene scene = scene_of(testkit::plane_mesh({0.1, 0.1}, 4, 4));
  SceneTexture laid;
  laid.index = 1;
  laid.texture.model = Fourier1d{kWave_mm, {0.0}, {0.0}, 0.0};
  laid.texture.height_offset_m = 1.5e-3;
  scene.objects[0].textures.push_back(laid);
  HapticTriangle all;
  all.texture = 1;
  scene.objects[0].mesh.haptic.assign(scene.objects[0].mesh.triangles.size(), all);
  TriangleMesh wall;
  wall.vertices_m = {{0.05, -0.05, -0.05}, {0.05, 0.15, -0.05}, {0.05, 0.15, 0.15}, {0.05, -0.05, 0.15}};
  wall.triangles = {{0, 2, 1}, {0, 3, 2}};
  scene.objects.push_back(testing_render::object_of(wall));
  const RenderModel model = make_render_model(scene, {});
  ServoState state;
  Vector3d before_N = stroke(model, state, {0.045, 0.05, 3e-3}, {0.045, 0.05, 0.7e-3}, 1e-5).texture_N;
  EXPECT_NEAR(before_N.z(), kStiffness * 0.8e-3, 1e-6);
  const auto go = [&](double x_m) {
    const Vector3d f_N = render_step(model, state, at({x_m, 0.05, 0.7e-3})).texture_N;
    EXPECT_LT((f_N - before_N).norm(), 1.01 * 1.5 / 50.0 * 0.8) << x_m;  // 0.05 s of 1 ms
    before_N = f_N;
  };
  for (int k = 0; k < 480; ++k) go(0.045 + 1e-5 * k);
  EXPECT_NEAR(before_N.norm(), 0.0, 0.8);
  for (int k = 0; k < 100; ++k) go(0.0498);
  EXPECT_EQ(before_N, Vector3d::Zero());
  for (int k = 480; k > 0; --k) go(0.045 + 1e-5 * k);
  EXPECT_NEAR(before_N.z(), kStiffness * 0.8e-3, 1e-6);
}

}  // namespace
}  // namespace asperity
