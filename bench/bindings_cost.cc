// What the same work costs by C++ and by the C library: bindings_cost FOLDER [REPEATS]
//
// FOLDER gets ball.obj and stroke.texture.json, which bench/bindings_cost.py reads to do the same from Python. Printed
// are medians over REPEATS (5) interleaved runs of the processor's time of this thread, a line `name ns` each.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <functional>
#include <map>
#include <numbers>
#include <string>
#include <vector>

#include <asperity_feel.h>
#include <fmt/format.h>

#include "asperity/base/output.h"
#include "asperity/base/random.h"
#include "asperity/device/vibration_axis.h"
#include "asperity/geometry/mesh_bvh.h"
#include "asperity/geometry/read_mesh.h"
#include "asperity/render/render_step.h"
#include "asperity/scene/paint.h"
#include "asperity/scene/read_scene.h"
#include "asperity/texture/fit_fourier1d.h"
#include "asperity/texture/fourier1d_model.h"
#include "asperity/texture/texture_file.h"

namespace {

using namespace asperity;

constexpr int kAround = 264, kUp = 133;  // 69,696 triangles
constexpr std::size_t kPoints = 100000, kHeights = 1000000, kSteps = 20000;

double now_s() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

std::string ball_obj() {
  std::string out;
  for (int row = 1; row < kUp; ++row) {
    const double latitude = (static_cast<double>(row) / kUp - 0.5) * std::numbers::pi;
    for (int c = 0; c < kAround; ++c) {
      const double longitude = 2.0 * std::numbers::pi * c / kAround;
      out += fmt::format("v {:.9f} {:.9f} {:.9f}\n", 0.03 * std::cos(latitude) * std::cos(longitude),
                         0.03 * std::cos(latitude) * std::sin(longitude), 0.03 * std::sin(latitude));
    }
  }
  out += "v 0 0 -0.03\nv 0 0 0.03\n";
  const auto index = [](int row, int c) { return row * kAround + c % kAround + 1; };
  for (int row = 0; row + 2 < kUp; ++row) {
    for (int c = 0; c < kAround; ++c) {
      out += fmt::format("f {} {} {}\nf {} {} {}\n", index(row, c), index(row, c + 1), index(row + 1, c + 1),
                         index(row, c), index(row + 1, c + 1), index(row + 1, c));
    }
  }
  const int south = (kUp - 1) * kAround + 1;
  for (int c = 0; c < kAround; ++c)
    out += fmt::format("f {} {} {}\nf {} {} {}\n", south, index(0, c + 1), index(0, c), index(kUp - 2, c),
                       index(kUp - 2, c + 1), south + 1);
  return out;
}

// The tip round the equator, 0.3 mm deep, after it has come from outside.
Eigen::Vector3d tip_at(std::size_t step) {
  const double depth_m = std::min(1e-6 * static_cast<double>(step), 0.8e-3) - 0.5e-3;
  const double angle = 0.1 + 2e-4 * static_cast<double>(step % 10000);
  return (0.03 - depth_m) * Eigen::Vector3d(std::cos(angle), std::sin(angle), 0.0);
}

Texture stroke_texture() {
  Random random(1, 0);
  std::vector<double> height_m;
  double h = 0.0;
  for (int i = 0; i < 400; ++i) height_m.push_back(h = 0.95 * h + 5e-6 * random.normal());
  Texture out;
  out.name = "stroke";
  out.model = fit_fourier1d(height_m, 25e-6, {}).texture;
  return out;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) {
    std::fputs("bindings_cost FOLDER [REPEATS]\n", stderr);
    return 2;
  }
  const std::filesystem::path folder = argv[1];
  const int repeats = argc > 2 ? std::max(1, std::atoi(argv[2])) : 5;
  std::filesystem::create_directories(folder);
  const std::filesystem::path mesh_file = folder / "ball.obj", texture_file = folder / "stroke.texture.json";
  write_file(mesh_file, ball_obj());
  write_texture(texture_file, stroke_texture());

  std::vector<double> line_m;
  std::vector<Eigen::Vector3d> points_m;
  for (int i = 0; i <= 40; ++i) {
    points_m.emplace_back(0.03 * Eigen::Vector3d(std::cos(0.06 * i), std::sin(0.06 * i), 0.0));
    for (int k = 0; k < 3; ++k) line_m.push_back(points_m.back()[k]);
  }
  Scene scene = read_scene(mesh_file);
  SceneTexture painted;
  painted.index = 0;
  painted.file = texture_file.string();
  painted.texture = read_texture(texture_file);
  HapticCoordinatesConfig wide;
  wide.half_width_mm = 4.0;
  paint(scene.objects.front(), points_m, painted, wide);
  RenderConfig config;
  config.tip_radius_m = 0.0005;
  const RenderModel model = make_render_model(scene, config);

  asperity_scene* c_scene = nullptr;
  asperity_settings* settings = nullptr;
  asperity_feel* feel = nullptr;
  const auto must = [](asperity_status status) {
    if (status == ASPERITY_OK) return;
    std::fprintf(stderr, "%s\n", asperity_last_error());
    std::exit(1);
  };
  must(asperity_scene_read(mesh_file.c_str(), &c_scene));
  must(asperity_scene_paint(c_scene, 0, texture_file.c_str(), line_m.data(), points_m.size(), 0.004, 0));
  must(asperity_settings_create(&settings));
  must(asperity_settings_set(settings, "tip_radius_m", "0.0005"));
  must(asperity_feel_create(c_scene, settings, &feel));

  std::vector<asperity_motion> motions(kSteps);
  std::vector<asperity_touch> touches(kSteps);
  std::vector<DeviceState> states(kSteps);
  for (std::size_t i = 0; i < kSteps; ++i) {
    const Eigen::Vector3d p = tip_at(i),
                          v = i > 0 ? Eigen::Vector3d((p - tip_at(i - 1)) / 1e-3) : Eigen::Vector3d::Zero();
    states[i] = {p, v, 1e-3};
    asperity_motion_init(&motions[i], sizeof motions[i]);
    asperity_touch_init(&touches[i], sizeof touches[i]);
    for (int k = 0; k < 3; ++k) motions[i].position_m[k] = p[k], motions[i].velocity_mps[k] = v[k];
    motions[i].dt_s = 1e-3;
  }

  const TriangleMesh mesh = to_metres(scene.objects.front().mesh, 1.0);
  const MeshBvh bvh(mesh);
  Random random(2, 0);
  std::vector<Eigen::Vector3d> where(kPoints);
  for (Eigen::Vector3d& p : where)
    p = Eigen::Vector3d(random.uniform(), random.uniform(), random.uniform()) * 0.12 - Eigen::Vector3d::Constant(0.06);
  std::vector<double> out(kHeights);
  double sum = 0.0, largest_N = 0.0;
  bool same = true;

  asperity_touch touch;
  asperity_touch_init(&touch, sizeof touch);
  std::map<std::string, std::vector<double>> took;
  const auto time = [&](const std::string& name, std::size_t count, const std::function<void()>& work) {
    const double began = now_s();
    work();
    took[name].push_back(1e9 * (now_s() - began) / static_cast<double>(count));
  };
  for (int repeat = 0; repeat < repeats; ++repeat) {
    time("render_step", kSteps, [&] {
      ServoState state;
      for (std::size_t i = 0; i < kSteps; ++i) {
        const ServoOutput force = render_step(model, state, states[i]);
        largest_N = std::max(largest_N, force.force_N.norm());
      }
    });
    // The C library's step also gives the part of the force that vibrates.
    time("render_step_and_vibration", kSteps, [&] {
      ServoState state;
      VibrationAxis vibration;
      for (std::size_t i = 0; i < kSteps; ++i) {
        const ServoOutput force = render_step(model, state, states[i]);
        sum += vibration.push(force.force_N, states[i].v_world_mps, 1000000 * static_cast<std::int64_t>(i));
      }
    });
    time("asperity_feel_step", kSteps, [&] {
      asperity_feel_reset(feel);
      for (std::size_t i = 0; i < kSteps; ++i) asperity_feel_step(feel, &motions[i], &touch);
    });
    time("asperity_feel_steps", kSteps, [&] {
      asperity_feel_reset(feel);
      asperity_feel_steps(feel, motions.data(), touches.data(), kSteps);
    });
    time("closest_point", kPoints, [&] {
      for (const Eigen::Vector3d& p : where) sum += bvh.closest_point(p).distance_m;
    });
    time("texture_height", kHeights, [&] {
      const auto& series = std::get<Fourier1d>(painted.texture.model);
      for (std::size_t i = 0; i < kHeights; ++i)
        out[i] = TextureModelTraits<Fourier1d>::height(series, 1e-7 * static_cast<double>(i), 0.0).height_m;
    });
  }
  double c_largest_N = 0.0;
  for (const asperity_touch& one : touches)
    c_largest_N = std::max(c_largest_N, std::hypot(one.force_N[0], one.force_N[1], one.force_N[2]));
  same = std::abs(c_largest_N - largest_N) < 1e-12;
  for (auto& [name, times] : took) {
    std::sort(times.begin(), times.end());
    fmt::print("{} {:.1f}\n", name, times[times.size() / 2]);
  }
  fmt::print("largest force {:.6f} N by C++, {:.6f} N by C; checks {:.6g} {:.6g}\n", largest_N, c_largest_N, sum,
             out.back());
  asperity_feel_free(feel);
  asperity_settings_free(settings);
  asperity_scene_free(c_scene);
  return same ? 0 : 1;
}
