#include "servo_plate.h"

#include <atomic>
#include <memory>

#include "asperity/device/servo_loop.h"
#include "asperity/device/sim_device.h"
#include "asperity/render/render_model.h"

namespace asperity {

namespace {

constexpr double kSide_m = 0.2;

// A plate in y = 0, facing up, under a texture of 128 harmonics.
Scene plate() {
  SceneObject object;
  object.mesh.vertices = {
      {-kSide_m, 0.0, -kSide_m}, {kSide_m, 0.0, -kSide_m}, {kSide_m, 0.0, kSide_m}, {-kSide_m, 0.0, kSide_m}};
  object.mesh.triangles = {{0, 2, 1}, {0, 3, 2}};
  for (const Triangle& t : object.mesh.triangles) {
    HapticTriangle haptic;
    haptic.texture = 1;
    for (std::size_t k = 0; k < 3; ++k) {
      const Eigen::Vector3d& v = object.mesh.vertices[t[k]];
      haptic.xy_mm[k] = 1e3 * Eigen::Vector2d(v.x(), -v.z());
    }
    object.mesh.haptic.push_back(haptic);
  }
  Fourier1d series;
  for (int j = 1; j <= 128; ++j) {
    series.a_m.push_back(20e-6 / j);
    series.b_m.push_back(10e-6 / j);
  }
  SceneTexture laid;
  laid.texture.model = series;
  object.textures.push_back(laid);
  Scene scene;
  scene.objects.push_back(object);
  return scene;
}

}  // namespace

ServoStatistics stroke_plate(double seconds, double rate_Hz, double spin_s) {
  SimDeviceConfig sim;
  sim.rate_Hz = rate_Hz;
  sim.stroke.speed_mps = 0.1 / seconds;
  sim.stroke.length_m = 0.15;
  const auto device = open_sim(sim);
  RenderConfig render;
  render.friction = 0.3;
  SnapshotExchange<const RenderModel> scene(std::make_unique<const RenderModel>(make_render_model(plate(), render)));
  ServoConfig config;
  config.rate_Hz = rate_Hz;
  config.duration_s = seconds;
  config.spin_s = spin_s;
  config.timed = true;
  config.frame.translation_m.y() = 2e-3;  // begins above the plate
  const std::atomic<bool> stop{false};
  return run_servo(*device, scene, config, stop, nullptr).statistics;
}

}  // namespace asperity
