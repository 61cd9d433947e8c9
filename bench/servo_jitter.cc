// How well the servo loop keeps its schedule on this machine: the simulated hand strokes a textured plate for SECONDS
// at RATE, with the sleep and spin of the defaults, and for a fifth of that by sleeping alone.
//
//   servo_jitter [SECONDS [RATE]]      100 s and 1000 Hz if not given

#include <algorithm>
#include <atomic>
#include <cstdio>
#include <exception>
#include <memory>
#include <string>

#include "asperity/base/error.h"
#include "asperity/base/text.h"
#include "asperity/device/servo_loop.h"
#include "asperity/device/sim_device.h"
#include "asperity/render/render_model.h"

namespace {

using asperity::Error;

constexpr double kSide_m = 0.2;

// A plate in y = 0, facing up, under a texture of 128 harmonics.
asperity::Scene plate() {
  asperity::SceneObject object;
  object.mesh.vertices = {
      {-kSide_m, 0.0, -kSide_m}, {kSide_m, 0.0, -kSide_m}, {kSide_m, 0.0, kSide_m}, {-kSide_m, 0.0, kSide_m}};
  object.mesh.triangles = {{0, 2, 1}, {0, 3, 2}};
  for (const asperity::Triangle& t : object.mesh.triangles) {
    asperity::HapticTriangle haptic;
    haptic.texture = 1;
    for (std::size_t k = 0; k < 3; ++k) {
      const Eigen::Vector3d& v = object.mesh.vertices[t[k]];
      haptic.xy_mm[k] = 1e3 * Eigen::Vector2d(v.x(), -v.z());
    }
    object.mesh.haptic.push_back(haptic);
  }
  asperity::Fourier1d series;
  for (int j = 1; j <= 128; ++j) {
    series.a_m.push_back(20e-6 / j);
    series.b_m.push_back(10e-6 / j);
  }
  asperity::SceneTexture laid;
  laid.texture.model = series;
  object.textures.push_back(laid);
  asperity::Scene scene;
  scene.objects.push_back(object);
  return scene;
}

void measure(const char* name, double seconds, double rate_Hz, double spin_s) {
  asperity::SimDeviceConfig sim;
  sim.rate_Hz = rate_Hz;
  sim.stroke.speed_mps = 0.1 / seconds;
  sim.stroke.length_m = 0.15;
  const auto device = asperity::open_sim(sim);
  asperity::RenderConfig render;
  render.friction = 0.3;
  asperity::SnapshotExchange<const asperity::RenderModel> scene(
      std::make_unique<const asperity::RenderModel>(make_render_model(plate(), render)));
  asperity::ServoConfig config;
  config.rate_Hz = rate_Hz;
  config.duration_s = seconds;
  config.spin_s = spin_s;
  config.timed = true;
  config.frame.translation_m.y() = 2e-3;  // begins above the plate
  const std::atomic<bool> stop{false};
  const asperity::ServoResult result = run_servo(*device, scene, config, stop, nullptr);
  const asperity::ServoStatistics& s = result.statistics;
  std::printf("%-11s %8llu %8llu %8llu %6llu %9.2f %9.2f %9.2f %9.2f %9.2f %9.2f  %s\n", name,
              static_cast<unsigned long long>(s.ticks), static_cast<unsigned long long>(s.overruns),
              static_cast<unsigned long long>(s.skipped), static_cast<unsigned long long>(s.lost_ticks),
              1e6 * s.late_p50_s, 1e6 * s.late_p99_s, 1e6 * s.late_max_s, 1e6 * s.step_p50_s, 1e6 * s.step_p99_s,
              1e6 * s.step_max_s, s.real_time ? "SCHED_FIFO" : "no priority");
  std::fflush(stdout);
}

double number(const char* text, double low, double high) {
  const auto value = asperity::parse_double(text);
  if (!value || !(*value >= low && *value <= high)) throw Error(std::string("'") + text + "' is out of range");
  return *value;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    const double seconds = argc > 1 ? number(argv[1], 1.0, 1e5) : 100.0;
    const double rate_Hz = argc > 2 ? number(argv[2], 100.0, 4000.0) : 1000.0;
    const asperity::ServoConfig defaults;
    std::printf("%g s at %g Hz; times in µs\n%-11s %8s %8s %8s %6s %9s %9s %9s %9s %9s %9s\n", seconds, rate_Hz, "",
                "ticks", "overruns", "skipped", "lost", "late p50", "p99", "max", "step p50", "p99", "max");
    measure("sleep", std::max(seconds / 5.0, 1.0), rate_Hz, 0.0);
    measure("sleep+spin", seconds, rate_Hz, defaults.spin_s);
  } catch (const std::exception& e) {
    std::fprintf(stderr, "servo_jitter: %s\n", e.what());
    return 1;
  }
  return 0;
}
