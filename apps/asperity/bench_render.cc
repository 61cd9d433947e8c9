#include "bench_render.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include <Eigen/Geometry>

#include "asperity/base/error.h"
#include "asperity/base/random.h"
#include "asperity/render/render_step.h"
#include "asperity/simulation/make_pebble.h"

namespace asperity::app {

using Eigen::Vector3d;

namespace {

constexpr double kRate_Hz = 1000.0;
constexpr double kSpeed_mps = 0.1;
constexpr double kDepth_m = 1e-3;
constexpr std::size_t kSteps = 100'000;

Texture many_waves() {
  constexpr std::size_t kHarmonics = 128;
  constexpr double kRms_m = 20e-6;
  Random random(3);
  Fourier1d series;
  series.length_mm = 10.0;
  for (std::size_t j = 0; j < kHarmonics; ++j) {
    const double amplitude_m = kRms_m * std::sqrt(2.0 / kHarmonics),
                 phase = random.uniform(0.0, 2.0 * std::numbers::pi);
    series.a_m.push_back(amplitude_m * std::cos(phase));
    series.b_m.push_back(amplitude_m * std::sin(phase));
  }
  Texture out;
  out.name = "128 waves";
  out.model = series;
  out.friction = 0.3;
  return out;
}

// Places under the surface that follow one another at the speed of the hand.
std::vector<Vector3d> random_walk(const RenderObject& object) {
  Eigen::AlignedBox3d box;
  for (const Vector3d& vertex_m : object.mesh.vertices_m) box.extend(vertex_m);
  const double depth_m = std::min(kDepth_m, 0.02 * box.diagonal().norm());
  const double step_m = kSpeed_mps / kRate_Hz;
  Random random(4);
  std::vector<Vector3d> out;
  ClosestPoint on = object.bvh.closest_point(box.max());
  Vector3d direction = Vector3d::UnitX();
  while (out.size() < kSteps) {
    const Vector3d& normal = object.normals[on.triangle];
    direction += 0.02 * Vector3d(random.normal(), random.normal(), random.normal());
    direction = (direction - direction.dot(normal) * normal).normalized();
    if (!direction.allFinite()) direction = normal.unitOrthogonal();
    out.push_back(object.T_world_mesh * Vector3d(on.p_m - depth_m * normal));
    on = object.bvh.closest_point(on.p_m + step_m * direction, on);
  }
  return out;
}

double nanoseconds(std::chrono::steady_clock::duration time) {
  return std::chrono::duration<double, std::nano>(time).count();
}

double part_of(std::vector<double> values, double part) {
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(part * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

}  // namespace

Scene make_render_bench() {
  PebbleConfig config;
  config.semi_axes_m = {0.05, 0.05, 0.05};
  config.bump_m = 1e-3;
  config.facet_m = 1.02e-3;
  SceneObject object;
  const TriangleMesh mesh = make_pebble(config);
  object.mesh_file = "bumpy sphere";
  object.mesh.vertices = mesh.vertices_m;
  object.mesh.triangles = mesh.triangles;
  object.mesh.haptic.resize(mesh.triangles.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    HapticTriangle& haptic = object.mesh.haptic[t];
    haptic.texture = 1;
    for (std::size_t k = 0; k < 3; ++k) haptic.xy_mm[k] = 1e3 * mesh.vertices_m[mesh.triangles[t][k]].head<2>();
  }
  object.textures.push_back({1, "waves.texture.json", many_waves()});
  Scene scene;
  scene.objects.push_back(std::move(object));
  return scene;
}

void time_rendering(const Scene& scene, double tip_radius_m, Json& out) {
  using Clock = std::chrono::steady_clock;
  RenderConfig config;
  config.tip_radius_m = tip_radius_m;
  config.friction = 0.3;
  const RenderModel model = make_render_model(scene, config);
  const std::vector<Vector3d> walk = random_walk(model.objects.front());

  // Down from outside, for nothing is felt of an object in which the tip begins.
  const auto run = [&](auto step) {
    ServoState state;
    DeviceState device;
    device.dt_s = 1.0 / kRate_Hz;
    const RenderObject& object = model.objects.front();
    const ClosestPoint start = object.bvh.closest_point(object.T_world_mesh.inverse() * walk.front());
    const Vector3d outward = object.T_world_mesh.rotation * object.normals[start.triangle];
    for (int i = 20; i > 0; --i) {
      device.p_world_m = walk.front() + 0.2 * static_cast<double>(i) * kDepth_m * outward;
      render_step(model, state, device);
    }
    for (const Vector3d& p_m : walk) {
      device.v_world_mps = (p_m - device.p_world_m) * kRate_Hz;
      device.p_world_m = p_m;
      step(state, device);
    }
  };
  double sum_N = 0.0;
  std::size_t touching = 0;
  const auto begin = Clock::now();
  run([&](ServoState& state, const DeviceState& device) {
    const ServoOutput output = render_step(model, state, device);
    sum_N += output.force_N.norm();
    touching += output.contact.found() ? 1 : 0;
  });
  const double whole_s = 1e-9 * nanoseconds(Clock::now() - begin);
  if (touching == 0 || !(sum_N > 0.0)) throw Error("bench: the tip never touched the mesh; check --mesh-unit");
  std::vector<double> single_us;
  single_us.reserve(walk.size());
  run([&](ServoState& state, const DeviceState& device) {
    const auto from = Clock::now();
    sum_N += render_step(model, state, device).force_N.norm();
    single_us.push_back(1e-3 * nanoseconds(Clock::now() - from));
  });
  out["triangles"] = model.objects.front().mesh.triangles.size();
  out["steps"] = walk.size();
  out["tip_radius_m"] = tip_radius_m;
  out["in_contact"] = static_cast<double>(touching) / static_cast<double>(walk.size());
  out["figures"] = {{"updates_per_s", static_cast<double>(walk.size()) / whole_s},
                    {"p50_us", part_of(single_us, 0.5)},
                    {"p99_us", part_of(single_us, 0.99)},
                    {"max_us", part_of(single_us, 1.0)},
                    {"mean_force_N", 0.5 * sum_N / static_cast<double>(walk.size())}};
}

}  // namespace asperity::app
