// The proxy over 100 s of stroking a bumpy sphere, judged by exact minima: docs/render-accuracy.md.
//   render_soak [seconds [seed]]      every case; fails if one is stuck, pops through, freezes, allocates or errs by
//                                     more than 10 mN RMS, or rests a tenth of a newton beside its own minimum
//   render_soak seconds seed frequency tip_mm speed_mm_per_s 0|1      one case, friction off or on
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>

#include "asperity/render/render_step.h"
#include "asperity/testkit/bumpy_sphere.h"
#include "asperity/testkit/count_allocations.h"
#include "asperity/testkit/proxy_judge.h"
#include "asperity/testkit/wandering_path.h"
#include "render_cases.h"

namespace {

using asperity::MeshBvh;
using asperity::TriangleMesh;
using Eigen::Vector3d;

constexpr double kMostRms_N = 10e-3;  // of the force against the tracked minimum's
constexpr double kMostLocal_N = 0.1;  // of the force against that of the proxy's own minimum: a step of it is felt

struct Totals {
  std::size_t allocations = 0, steps = 0;
  bool passed = true;
};

void soak(const TriangleMesh& mesh, const MeshBvh& bvh, double tip_m, double speed_mps, bool friction, double seconds,
          std::uint64_t seed, Totals& totals) {
  namespace testkit = asperity::testkit;
  const auto ticks = static_cast<std::size_t>(seconds / bench::kTick_s);
  const testkit::PressedPath path = testkit::press_into(
      bvh, testkit::wandering_directions(ticks, speed_mps * bench::kTick_s / bench::kSphere_m, seed), tip_m,
      bench::kDepth_m);
  const asperity::RenderModel model =
      asperity::make_render_model(bench::scene_of(mesh, friction), bench::config_of(tip_m, friction));
  asperity::ServoState state;
  asperity::DeviceState device;
  testkit::ProxyJudge judge(mesh, bvh, {tip_m, bench::kDepth_m, !friction});
  double error2 = 0.0, worst_N = 0.0, largest_N = 0.0, steepest = 0.0;
  std::size_t over_cone = 0, pushing = 0, pressed = 0, allocations = 0, worst_tick = 0;
  Vector3d proxy_m = path.p_m.front();
  for (std::size_t i = 0; i < path.p_m.size(); ++i) {
    const Vector3d& p = path.p_m[i];
    device.v_world_mps = i > 0 ? Vector3d((p - device.p_world_m) / bench::kTick_s) : Vector3d::Zero();
    device.p_world_m = p;
    device.dt_s = bench::kTick_s;
    const std::size_t before = testkit::count_allocations();
    const asperity::ServoOutput out = asperity::render_step(model, state, device);
    allocations += testkit::count_allocations() - before;
    judge.tick(p, out.proxy_m);
    if (i >= path.first_pressed) ++pressed;
    largest_N = std::max(largest_N, out.contact_N.norm());
    if (friction) {
      const double normal_N = (out.contact_N + out.texture_N).norm(), rub_N = out.friction_N.norm();
      over_cone += rub_N > bench::kFriction * bench::kStaticRatio * normal_N * (1.0 + 1e-6) + 1e-9;
      // A proxy that falls off a fold or turns over an edge goes a way of its own within one tick: rare.
      const Vector3d slid_m = out.proxy_m - proxy_m;
      const bool falls = slid_m.norm() > 3.0 * speed_mps * bench::kTick_s;
      pushing += !out.sticking && !falls && rub_N > 1e-9 && out.friction_N.dot(slid_m) > 1e-9 * rub_N * bench::kDepth_m;
      if (normal_N > 0.0) steepest = std::max(steepest, rub_N / normal_N);
    } else if (i >= path.first_pressed) {
      const double error_N = (out.force_N - bench::kStiffness_N_per_m * (judge.true_m() - p)).norm();
      error2 += error_N * error_N;
      if (error_N > worst_N) worst_tick = i;
      worst_N = std::max(worst_N, error_N);
    }
    proxy_m = out.proxy_m;
  }
  const testkit::ProxyStatistics f = judge.statistics();
  const double count = static_cast<double>(std::max<std::size_t>(pressed, 1));
  const double rms_N = std::sqrt(error2 / count);
  std::printf("%8zu %4.1f %4.0f %-3s %5zu %4zu %6zu %6.3f %6.2f %9.1e", mesh.triangles.size(), 1e3 * tip_m,
              1e3 * speed_mps, friction ? "on" : "off", f.stuck_events, f.pop_throughs, f.frozen_ticks,
              1e3 * f.largest_lag_m, largest_N, 1e6 * f.deepest_proxy_m);
  if (friction) {
    std::printf("  cone exceeded %zu, pushing %zu, largest ratio %.4f", over_cone, pushing, steepest);
  } else {
    std::printf(" %7.2f %7.1f %7.3f %9.1e %8.1e %8.1f  %6zu", 1e3 * rms_N, 1e3 * worst_N,
                100.0 * static_cast<double>(f.other_basin) / count, 1e3 * bench::kStiffness_N_per_m * f.rms_local_m,
                1e3 * bench::kStiffness_N_per_m * f.largest_local_m, 1e6 * f.largest_step_excess_m, worst_tick);
  }
  std::printf("\n");
  std::fflush(stdout);
  totals.allocations += allocations;
  totals.steps += path.p_m.size();
  totals.passed = totals.passed && f.stuck_events == 0 && f.pop_throughs == 0 && f.frozen_ticks == 0 &&
                  allocations == 0 && rms_N <= kMostRms_N &&
                  bench::kStiffness_N_per_m * f.largest_local_m <= kMostLocal_N && over_cone == 0 &&
                  pushing * 1000 <= pressed;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    const double seconds = argc > 1 ? std::atof(argv[1]) : 100.0;
    const auto seed = static_cast<std::uint64_t>(argc > 2 ? std::atoi(argv[2]) : 1);
    std::printf("%g s a case, seed %d, %g mm deep, %g N/m, steps of %g ms\n", seconds, static_cast<int>(seed),
                1e3 * bench::kDepth_m, bench::kStiffness_N_per_m, 1e3 * bench::kTick_s);
    std::printf(
        "                                          lag  force    inside     force error, mN   other  to own, mN  "
        "     step\n");
    std::printf(
        "triangles tip mm/s rub stuck  pop frozen     mm      N        um     RMS    most basin %%       RMS     "
        "most     um at tick\n");
    Totals totals;
    if (argc > 6) {
      const TriangleMesh mesh = asperity::testkit::bumpy_sphere_mesh(std::atoi(argv[3]));
      soak(mesh, MeshBvh(mesh), 1e-3 * std::atof(argv[4]), 1e-3 * std::atof(argv[5]), std::atoi(argv[6]) != 0, seconds,
           seed, totals);
      return totals.passed ? 0 : 1;
    }
    for (const int frequency : {bench::kFrequency70k, bench::kFrequency1M}) {
      const TriangleMesh mesh = asperity::testkit::bumpy_sphere_mesh(frequency);
      const MeshBvh bvh(mesh);
      for (const double tip_m : {0.0, 0.5e-3, 2e-3}) {
        for (const double speed_mps : {0.02, 0.1}) {
          for (const bool friction : {false, true}) soak(mesh, bvh, tip_m, speed_mps, friction, seconds, seed, totals);
        }
      }
    }
    std::printf("%zu allocations in %zu steps: %s\n", totals.allocations, totals.steps,
                totals.passed ? "passed" : "FAILED");
    return totals.passed ? 0 : 1;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "render_soak: %s\n", error.what());
    return 1;
  }
}
