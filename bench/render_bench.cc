// Servo steps a second on one core, friction and a Fourier texture of 128 harmonics on: render_bench [repetitions].
// Beside them, on the same path, what others would pay: Embree's closest-point query alone, where it is installed, and
// the textbooks' god object, without friction and texture.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <exception>
#include <memory>
#include <vector>

#include "asperity/render/render_step.h"
#include "asperity/testkit/bumpy_sphere.h"
#include "asperity/testkit/proxy_judge.h"
#include "asperity/testkit/wandering_path.h"
#include "peers/closest_peer.h"
#include "peers/god_object.h"
#include "render_cases.h"

namespace {

using asperity::MeshBvh;
using asperity::TriangleMesh;
using Eigen::Vector3d;

constexpr double kSpeed_mps = 0.1;
constexpr std::size_t kTicks = 100000;

double cpu_s() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

double quantile(std::vector<double> values, double q) {
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(q * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

struct Timing {
  std::vector<double> rate, p50_us, p99_us, most_us;
};

// One pass for the rate, one with a clock read at each tick for the quantiles.
template <class Start, class Step>
void time_pass(const std::vector<Vector3d>& path, Start start, Step step, Timing& timing) {
  start();
  const double begin_s = cpu_s();
  for (const Vector3d& p : path) step(p);
  timing.rate.push_back(static_cast<double>(path.size()) / (cpu_s() - begin_s));
  start();
  std::vector<double> us;
  us.reserve(path.size());
  for (const Vector3d& p : path) {
    const auto before = std::chrono::steady_clock::now();
    step(p);
    us.push_back(1e6 * std::chrono::duration<double>(std::chrono::steady_clock::now() - before).count());
  }
  timing.p50_us.push_back(quantile(us, 0.5));
  timing.p99_us.push_back(quantile(us, 0.99));
  timing.most_us.push_back(*std::max_element(us.begin(), us.end()));
}

void print_timing(const char* name, std::size_t triangles, double tip_m, const Timing& timing) {
  std::printf("%-28s %9zu %5.1f %12.0f %8.2f %8.2f %9.1f\n", name, triangles, 1e3 * tip_m, quantile(timing.rate, 0.5),
              quantile(timing.p50_us, 0.5), quantile(timing.p99_us, 0.5), quantile(timing.most_us, 0.5));
  std::fflush(stdout);
}

void judge_god_object(const TriangleMesh& mesh, const MeshBvh& bvh, const std::vector<Vector3d>& path) {
  bench::GodObject god(mesh, bvh);
  asperity::testkit::ProxyJudge judge(mesh, bvh, {0.0, bench::kDepth_m, true});
  for (const Vector3d& p : path) judge.tick(p, god.step(p));
  const auto f = judge.statistics();
  std::printf(
      "  the god object in %.0f s: %zu stuck events, %zu pop-throughs, lag up to %.2f mm, %zu frozen ticks, error "
      "%.0f mN RMS, steps of up to %.0f um too much\n",
      static_cast<double>(f.ticks) * bench::kTick_s, f.stuck_events, f.pop_throughs, 1e3 * f.largest_lag_m,
      f.frozen_ticks, 1e3 * bench::kStiffness_N_per_m * f.rms_error_m, 1e6 * f.largest_step_excess_m);
}

void bench_mesh(int frequency, int repetitions) {
  namespace testkit = asperity::testkit;
  const TriangleMesh mesh = testkit::bumpy_sphere_mesh(frequency);
  const MeshBvh bvh(mesh);
  const auto directions = testkit::wandering_directions(kTicks, kSpeed_mps * bench::kTick_s / bench::kSphere_m, 1);
  for (const double tip_m : {0.0, 0.5e-3, 2e-3}) {
    const std::vector<Vector3d> path = testkit::press_into(bvh, directions, tip_m, bench::kDepth_m).p_m;
    const asperity::RenderModel model =
        asperity::make_render_model(bench::scene_of(mesh, true), bench::config_of(tip_m, true));
    asperity::ServoState state;
    asperity::DeviceState device;
    Vector3d sum_N = Vector3d::Zero();
    Timing ours, god_timing, embree;
    std::unique_ptr<bench::GodObject> god;
#ifdef ASPERITY_HAVE_EMBREE
    const auto peer = bench::make_embree_peer(mesh);
    std::vector<double> distances(path.size());
#endif
    for (int repetition = 0; repetition < repetitions; ++repetition) {
      time_pass(
          path,
          [&] {
            state = {};
            device = {};
            device.p_world_m = path.front();
          },
          [&](const Vector3d& p) {
            device.v_world_mps = (p - device.p_world_m) / bench::kTick_s;
            device.p_world_m = p;
            sum_N += asperity::render_step(model, state, device).force_N;
          },
          ours);
      if (tip_m > 0.0) continue;
      time_pass(
          path, [&] { god = std::make_unique<bench::GodObject>(mesh, bvh); },
          [&](const Vector3d& p) { sum_N += god->step(p) - p; }, god_timing);
#ifdef ASPERITY_HAVE_EMBREE
      const double begin_s = cpu_s();
      peer->distances(path, true, distances);
      embree.rate.push_back(static_cast<double>(path.size()) / (cpu_s() - begin_s));
#endif
    }
    print_timing("render_step", mesh.triangles.size(), tip_m, ours);
    if (tip_m == 0.0) {
      print_timing("god object", mesh.triangles.size(), tip_m, god_timing);
      if (!embree.rate.empty()) {
        std::printf("%-28s %9zu %5.1f %12.0f\n", "Embree's closest point alone", mesh.triangles.size(), 0.0,
                    quantile(embree.rate, 0.5));
      }
      judge_god_object(mesh, bvh, path);
    }
    if (!sum_N.allFinite()) std::printf("  a force is not finite\n");
  }
}

}  // namespace

int main(int argc, char** argv) {
  try {
    const int repetitions = argc > 1 ? std::max(1, std::atoi(argv[1])) : 5;
    std::printf("%zu steps at %.0f mm/s, %.0f mm deep; medians of %d interleaved runs\n", kTicks, 1e3 * kSpeed_mps,
                1e3 * bench::kDepth_m, repetitions);
    std::printf("%-28s %9s %5s %12s %8s %8s %9s\n", "", "triangles", "mm", "updates/s", "p50 us", "p99 us", "most us");
    bench_mesh(bench::kFrequency70k, repetitions);
    bench_mesh(bench::kFrequency1M, repetitions);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "render_bench: %s\n", error.what());
    return 1;
  }
  return 0;
}
