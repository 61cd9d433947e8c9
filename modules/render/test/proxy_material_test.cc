// A texture that brings stiffness, compliance or friction of its own: no step at its border nor at an exchange.
#include <algorithm>
#include <cmath>
#include <optional>

#include <gtest/gtest.h>

#include "asperity/testkit/shape_meshes.h"
#include "scenes.h"

namespace asperity {
namespace {

using Eigen::Vector3d;
using testing_render::at;
using testing_render::scene_of;
using testing_render::stroke;

constexpr double kScene_N_per_m = 1000.0;
constexpr double kDepth_m = 1e-3;

struct Own {
  std::optional<double> stiffness_N_per_m{}, compliance_kc{}, friction{};
};

// A plane with a wave of 0.1 mm on x < 0.05 m that brings `own`, times `scale` in all its lengths.
RenderModel model_of(const Own& own, double friction = 0.0, double scale = 1.0) {
  Scene scene = scene_of(testkit::plane_mesh({0.1, 0.1}, 40, 40));
  SceneTexture laid;
  laid.index = 3;
  laid.texture.model = Fourier1d{5.0 * scale, {0.05e-3 * scale}, {0.0}, 0.0};
  laid.texture.height_offset_m = 0.05e-3 * scale;
  laid.texture.stiffness_N_per_m = own.stiffness_N_per_m;
  laid.texture.compliance_kc = own.compliance_kc;
  laid.texture.friction = own.friction;
  scene.objects[0].textures.push_back(laid);
  MeshFile& mesh = scene.objects[0].mesh;
  for (Vector3d& v : mesh.vertices) v *= scale;
  for (const Triangle& t : mesh.triangles) {
    HapticTriangle haptic;
    double middle_m = 0.0;
    for (std::size_t k = 0; k < 3; ++k) {
      haptic.xy_mm[k] = 1e3 * mesh.vertices[t[k]].head<2>();
      middle_m += mesh.vertices[t[k]].x() / 3.0;
    }
    haptic.texture = middle_m < 0.05 * scale ? 3 : -1;
    mesh.haptic.push_back(haptic);
  }
  RenderConfig config;
  config.friction = friction;
  config.static_friction_ratio = 1.0;  // no stick and slip, which steps by itself
  config.border_fade_m *= scale;
  return make_render_model(scene, config);
}

// The steepest that 3t² - 2t³ makes of 600 N/m and 1 mm in a step of 1 µm. Friction that falls by 0.1 over 1 mm lets
// the proxy, 1 mm deep, go faster than the hand: by 1 / (1 - 0.1 · 1.5), and a little more with the texture's load.
TEST(ProxyMaterial, OfATextureFadesAtItsBorder) {
  const RenderModel model = model_of({.stiffness_N_per_m = 400.0, .compliance_kc = 0.5, .friction = 0.3}, 0.2);
  ServoState state;
  stroke(model, state, {0.03, 0.05, 0.01}, {0.04, 0.05, -kDepth_m}, 1e-5);
  ServoOutput before = stroke(model, state, {0.04, 0.05, -kDepth_m}, {0.047, 0.05, -kDepth_m}, 1e-5);
  ASSERT_NEAR(before.contact_N.z(), 400.0 * kDepth_m, 1e-12) << "inside the texture's own";
  double contact_N = 0.0, force_N = 0.0;
  for (int k = 1; k < 6000; ++k) {
    const ServoOutput out = render_step(model, state, at({0.047 + 1e-6 * k, 0.05, -kDepth_m}));
    contact_N = std::max(contact_N, (out.contact_N - before.contact_N).norm());
    force_N = std::max(force_N, (out.force_N - before.force_N).norm());
    before = out;
  }
  EXPECT_LE(contact_N, 1.3 * 600.0 * kDepth_m * 1.5 * 1e-3);
  // The texture's wave and its fade, and friction's, of no more than 0.3 of the load, come to no more than twice that.
  EXPECT_LE(force_N, 3.0 * 600.0 * kDepth_m * 1.5 * 1e-3);
  EXPECT_NEAR(before.contact_N.z(), kScene_N_per_m * kDepth_m, 1e-12) << "beside it the scene's";
}

// An exchange eases over 50 steps of 1 ms: the steepest is 1.5 / 50 of the difference a step.
TEST(ProxyMaterial, OfAnExchangedSnapshotEases) {
  const RenderModel soft = model_of({.stiffness_N_per_m = 400.0});
  const RenderModel hard = model_of({.stiffness_N_per_m = 1000.0});
  for (const bool hardens : {true, false}) {
    const RenderModel& first = hardens ? soft : hard;
    const RenderModel& second = hardens ? hard : soft;
    ServoState state;
    const Vector3d p_m(0.03, 0.05, -kDepth_m);
    ServoOutput before = stroke(first, state, {0.03, 0.05, 0.01}, p_m, 1e-5);
    const double start_N = before.contact_N.z();
    double most_N = 0.0;
    for (int k = 0; k < 60; ++k) {
      const ServoOutput out = render_step(second, state, at(p_m));
      EXPECT_TRUE(k > 0 || std::abs(out.contact_N.z() - start_N) < 1e-12);
      most_N = std::max(most_N, (out.force_N - before.force_N).norm());
      before = out;
    }
    EXPECT_LE(most_N, 1.1 * 1.5 / 50.0 * 0.6 * 1.1) << "with 0.1 mm of texture on 1 mm";
    EXPECT_GT(most_N, 0.0);
    ServoState fresh;
    EXPECT_NEAR(before.contact_N.z(), stroke(second, fresh, {0.03, 0.05, 0.01}, p_m, 1e-5).contact_N.z(), 1e-12);
  }
}

// Sliding with friction while two snapshots take turns, also before the last easing has ended.
TEST(ProxyMaterial, FrictionEasesToo) {
  const RenderModel rough = model_of({.stiffness_N_per_m = 600.0, .compliance_kc = 0.3, .friction = 0.6});
  const RenderModel smooth = model_of({.friction = 0.1});
  ServoState state;
  stroke(rough, state, {0.01, 0.05, 0.01}, {0.01, 0.05, -kDepth_m}, 1e-5);
  stroke(rough, state, {0.01, 0.05, -kDepth_m}, {0.015, 0.05, -kDepth_m}, 1e-5);
  Vector3d before_N = render_step(rough, state, at({0.015, 0.05, -kDepth_m})).force_N;
  double most_N = 0.0;
  for (int k = 1; k < 2000; ++k) {
    const RenderModel& model = (k / 35) % 2 == 1 ? smooth : rough;
    const Vector3d force_N = render_step(model, state, at({0.015 + 5e-6 * k, 0.05, -kDepth_m})).force_N;
    most_N = std::max(most_N, (force_N - before_N).norm());
    before_N = force_N;
  }
  EXPECT_LE(most_N, 2.0 * 1.5 / 50.0 * 0.5) << "differences of 0.4 N of load and 0.3 N of friction";
}

TEST(ProxyMaterial, OfANewContactDoesNotEase) {
  const RenderModel soft = model_of({.stiffness_N_per_m = 400.0});
  const RenderModel hard = model_of({.stiffness_N_per_m = 1000.0});
  ServoState state;
  const Vector3d above_m(0.03, 0.05, 0.01), p_m(0.03, 0.05, -kDepth_m);
  stroke(soft, state, above_m, p_m, 1e-5);
  stroke(soft, state, p_m, above_m, 1e-5);
  render_step(hard, state, at(above_m));
  EXPECT_NEAR(render_step(hard, state, at(p_m)).contact_N.z(), 1000.0 * kDepth_m, 1e-12);
  EXPECT_NEAR(render_step(soft, state, at(p_m)).contact_N.z(), 1000.0 * kDepth_m, 1e-12) << "an exchange";
  stroke(soft, state, above_m, above_m, 1e-5);
  EXPECT_NEAR(render_step(soft, state, at(p_m)).contact_N.z(), 400.0 * kDepth_m, 1e-12) << "ended in the air";
}

TEST(ProxyMaterial, ScalesByPowersOfTwo) {
  const double scale = 0x1p-7;
  const RenderModel model = model_of({.stiffness_N_per_m = 400.0});
  const RenderModel small = model_of({.stiffness_N_per_m = 400.0}, 0.0, scale);
  ServoState state, small_state;
  for (int k = 0; k < 400; ++k) {
    const Vector3d p_m(0.045 + 2e-5 * k, 0.05, 0.5e-3 - 1e-5 * std::min(k, 100));
    const Vector3d big_N = render_step(model, state, at(p_m)).contact_N;
    ASSERT_EQ(big_N * scale, render_step(small, small_state, at(scale * p_m)).contact_N) << k;
  }
}

TEST(ProxyMaterial, OfSnapshotsThatFeelAlikeHasOneId) {
  const Own own{.stiffness_N_per_m = 400.0};
  EXPECT_EQ(model_of(own).material_id, model_of(own).material_id);
  EXPECT_NE(model_of(own).material_id, model_of({}).material_id);
  EXPECT_NE(model_of({}, 0.1).material_id, model_of({}).material_id);
}

}  // namespace
}  // namespace asperity
