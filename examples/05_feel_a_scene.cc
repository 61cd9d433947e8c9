// A textured scene, a device, and the loop between them: what a program needs that lets people feel.
//
//   05_feel_a_scene [SCENE.json]
//
// Without a scene of your own, a plate is painted with a wave of 2.5 mm. The device is the modelled hand; those of
// open_haply.h, openhaptics_device.h and dhd_device.h are used alike.

#include <array>
#include <atomic>
#include <cstdio>
#include <exception>
#include <memory>

#include "asperity/device/servo_loop.h"
#include "asperity/device/sim_device.h"
#include "asperity/fidelity/surface_stroke.h"
#include "asperity/render/render_model.h"
#include "asperity/scene/paint.h"
#include "asperity/scene/read_scene.h"

namespace {

// Two triangles of 60 × 20 mm; the texture's x runs from (5, 10) to (55, 10) mm.
asperity::Scene paint_plate() {
  asperity::SceneObject plate;
  plate.mesh_file = "plate.obj";
  plate.mesh.vertices = {{0.0, 0.0, 0.0}, {0.06, 0.0, 0.0}, {0.06, 0.02, 0.0}, {0.0, 0.02, 0.0}};
  plate.mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  asperity::Fourier1d wave;
  wave.length_mm = 2.5;
  wave.a_m = {0.1e-3};
  wave.b_m = {0.0};
  asperity::SceneTexture texture;
  texture.file = "wave.texture.json";
  texture.texture.model = wave;
  const std::array<Eigen::Vector3d, 2> through_m{Eigen::Vector3d(5e-3, 10e-3, 0.0), Eigen::Vector3d(55e-3, 10e-3, 0.0)};
  asperity::paint(plate, through_m, texture);
  asperity::Scene scene;
  scene.objects.push_back(plate);
  return scene;
}

}  // namespace

int main(int argc, char** argv) try {
  const asperity::Scene scene = argc > 1 ? asperity::read_scene(argv[1]) : paint_plate();

  // What the servo thread reads: tables, trees, no files. A new one can be published while it runs.
  asperity::SnapshotExchange<const asperity::RenderModel> model(
      std::make_unique<const asperity::RenderModel>(asperity::make_render_model(scene, {})));

  // A hand that strokes the texture once to and fro, at 50 mm/s and with 1 N.
  const asperity::SurfaceLine line = asperity::shortened(asperity::textured_line(scene), 5e-3);
  const asperity::HandStroke stroke = asperity::stroke_along(line, 0.0, {});
  asperity::HandPath path;
  for (std::size_t i = 0; i < stroke.path.size(); ++i) {
    path.push_back({stroke.path.t_ns[i], stroke.path.p_world_m[i], stroke.press_N[i]});
  }
  asperity::SimDeviceConfig hand;
  Eigen::Vector3d::Map(hand.hand.press_direction.data()) = stroke.press_direction_world;
  const std::unique_ptr<asperity::HapticDevice> device = asperity::open_sim(hand, path);

  asperity::ServoConfig config;
  config.paced = false;  // nobody is there: as fast as it goes
  std::size_t touching = 0;
  double peak_N = 0.0, highest_m = 0.0;
  const std::atomic<bool> stop{false};
  const asperity::ServoResult result =
      asperity::run_servo(*device, model, config, stop, [&](const asperity::ServoTick& tick) {
        touching += tick.output.contact.found() ? 1 : 0;
        peak_N = std::max(peak_N, tick.out_world_N.norm());
        highest_m = std::max(highest_m, tick.output.texture_height_m);
      });
  std::printf("ticks    %llu, %.0f %% in contact\n", static_cast<unsigned long long>(result.statistics.ticks),
              100.0 * static_cast<double>(touching) / static_cast<double>(result.statistics.ticks));
  std::printf("force    at most %.2f N\ntexture  up to %.1f µm\n", peak_N, highest_m * 1e6);
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
