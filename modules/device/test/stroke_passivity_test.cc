#include <atomic>
#include <cmath>
#include <memory>

#include <gtest/gtest.h>

#include "asperity/device/safety_cause.h"
#include "asperity/device/servo_loop.h"
#include "asperity/device/sim_device.h"
#include "asperity/render/render_model.h"

namespace asperity {
namespace {

constexpr double kSide_m = 0.1;
constexpr double kBump_m = 0.5e-3;  // amplitude of the plate's bumps
constexpr double kBumpPitch_m = 20e-3;
constexpr double kTexture_m = 50e-6;  // amplitude of the texture's sine
constexpr double kTexturePitch_mm = 2.5;

// A plate that faces up, with bumps along x and, over them, a textured sine along x.
Scene bumpy_plate() {
  constexpr int kColumns = 400;
  SceneObject object;
  for (int i = 0; i <= kColumns; ++i) {
    const double x_m = kSide_m * (2.0 * i / kColumns - 1.0);
    const double y_m = kBump_m * std::sin(2.0 * EIGEN_PI * x_m / kBumpPitch_m);
    object.mesh.vertices.emplace_back(x_m, y_m, -kSide_m);
    object.mesh.vertices.emplace_back(x_m, y_m, kSide_m);
  }
  for (std::uint32_t i = 0; i < 2 * kColumns; i += 2) {
    object.mesh.triangles.push_back({i, i + 1, i + 3});
    object.mesh.triangles.push_back({i, i + 3, i + 2});
  }
  for (const Triangle& t : object.mesh.triangles) {
    HapticTriangle haptic;
    haptic.texture = 1;
    for (std::size_t k = 0; k < 3; ++k) {
      const Eigen::Vector3d& v = object.mesh.vertices[t[k]];
      haptic.xy_mm[k] = 1e3 * Eigen::Vector2d(v.x(), -v.z());
    }
    object.mesh.haptic.push_back(haptic);
  }
  Fourier1d sine;
  sine.length_mm = kTexturePitch_mm;
  sine.a_m = {kTexture_m};
  sine.b_m = {0.0};
  SceneTexture laid;
  laid.texture.model = sine;
  laid.texture.compliance_kc = 0.45;  // 450 N/m, Choi and Tan's limit
  object.textures.push_back(laid);
  Scene scene;
  scene.objects.push_back(object);
  return scene;
}

struct Stroke {
  std::size_t touching = 0;
  std::size_t damped = 0;
  double texture_N = 0.0;     // largest
  double difference_N = 0.0;  // largest of what was let through to what was rendered, after the soft start
};

Stroke stroke(double friction) {
  SimDeviceConfig sim;
  sim.stroke.start_m = {-0.05, 0.0, 0.0};
  sim.stroke.length_m = 0.1;
  sim.stroke.speed_mps = 0.05;
  sim.stroke.rest_s = 1.0;
  const std::unique_ptr<HapticDevice> device = open_sim(sim);
  RenderConfig render;
  render.stiffness_N_per_m = 1000.0;
  render.friction = friction;
  SnapshotExchange<const RenderModel> scene(
      std::make_unique<const RenderModel>(make_render_model(bumpy_plate(), render)));
  ServoConfig config;
  config.paced = false;
  config.frame.translation_m.y() = 2e-3;  // begins above the plate
  const std::atomic<bool> stop{false};
  Stroke result;
  run_servo(*device, scene, config, stop, [&](const ServoTick& t) {
    if (t.t_ns < 1'000'000'000 || t.output.contact_N.isZero(0.0)) return;
    ++result.touching;
    if (t.limited_by & flag(SafetyCause::kPassivity)) ++result.damped;
    result.texture_N = std::max(result.texture_N, t.output.texture_N.norm());
    result.difference_N = std::max(result.difference_N, (t.out_world_N - t.output.force_N).norm());
  });
  return result;
}

// What a hand does all day: a stroke at 50 mm/s over a bumpy, textured plate of 1 N/mm, pressed with 0.8 N. Nothing
// is unstable, so what is rendered reaches the hand unchanged once the soft start is over.
TEST(StrokePassivity, APlainStrokeIsLeftAlone) {
  for (const double friction : {0.0, 0.3}) {
    const Stroke s = stroke(friction);
    EXPECT_GT(s.touching, 2000U);
    EXPECT_GT(s.texture_N, 0.03);
    EXPECT_EQ(s.damped, 0U) << friction;
    EXPECT_EQ(s.difference_N, 0.0) << friction;
  }
}

}  // namespace
}  // namespace asperity
