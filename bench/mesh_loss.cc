// Where a profile over a mesh loses what one over a plane has: the scans of mesh_accuracy's arc over a pebble,
// registered from 5 mm and 5 degrees off, and the same with one error at a time. Prints a table in Markdown: medians
// over the seeds and the worst; docs/accuracy-mesh.md says what it means.
//
//   mesh_loss [--seeds N] [--surfaces sandpaper,protoboard] [--facet-mm 1.5] [--tracker-noise 1] [--each yes]
//
// With e = T_true⁻¹ T_found p − p_true, the position's error on the object at each sample, and n the object's normal
// there: `its error along the normal alone` has the positions p_true + (n·e) n over the true mesh, `along the surface`
// the rest of e. `measured positions` are the trajectory's, without the slow error and the tip's shift that the fit
// finds; `corrected` with them. `flat facets` takes none of their bulge. `a plane` is the same hand and probe over a
// plane.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <iterator>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "asperity/base/error.h"
#include "asperity/geometry/mesh_surface.h"
#include "asperity/pipeline/process_motion.h"
#include "asperity/pipeline/process_recording.h"
#include "asperity/pipeline/register_scans.h"
#include "asperity/pipeline/true_pose.h"
#include "asperity/profile/base_path_on_mesh.h"
#include "asperity/signal/statistics.h"
#include "asperity/simulation/make_pebble.h"
#include "asperity/simulation/make_surface.h"
#include "asperity/simulation/random_motion.h"
#include "asperity/simulation/randomise_pose.h"
#include "asperity/simulation/simulate_recording.h"
#include "read_options.h"

namespace {

using Eigen::Vector3d;
constexpr double kDegree = std::numbers::pi / 180.0;
constexpr const char* kArc =
    "-0.034,-0.012,0.0158;-0.02,0.008,0.0243;0,0.016,0.0251;0.02,0.008,0.0243;0.034,-0.012,0.0158";
constexpr const char* kCaseNames[] = {"as registered",
                                      "its error along the normal alone",
                                      "along the surface alone",
                                      "true positions",
                                      "found pose, measured positions",
                                      "true pose, measured positions",
                                      "true pose and tip, measured positions",
                                      "true pose, corrected positions",
                                      "flat facets",
                                      "a plane, same orientation",
                                      "a plane, facing the camera"};
constexpr std::size_t kCases = std::size(kCaseNames);

struct Options {
  int seeds = 10;
  std::vector<std::string> surfaces{"sandpaper"};
  double facet_m = 1.5e-3;
  double tracker_noise = 1.0;
  bool each = false;
};

Options parse_options(int argc, char** argv) {
  Options out;
  bench::read_options(
      argc, argv,
      {{"--seeds", [&](auto value) { out.seeds = bench::seed_count(value); }},
       {"--surfaces", [&](auto value) { out.surfaces = bench::split_list(value); }},
       {"--facet-mm", [&](auto value) { out.facet_m = 1e-3 * bench::number_within(value, 0.1, 10.0); }},
       {"--tracker-noise", [&](auto value) { out.tracker_noise = bench::number_within(value, 0.0, 10.0); }},
       {"--each", [&](auto value) { out.each = bench::is_first(value, "yes", "no"); }}});
  return out;
}

// The true positions at the motion's times, and the error of its own in the true world frame.
struct MotionError {
  std::vector<Vector3d> p_true_m, normal, along, error_m;
};

MotionError measure_error(const asperity::TipMotion& motion, const asperity::Truth& truth,
                          const asperity::Pose& T_true_found, const asperity::MeshSurface& surface,
                          const asperity::Pose& T_mesh_world) {
  MotionError out;
  const std::size_t n = motion.size();
  std::size_t next = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const std::int64_t t_ns = motion.t_ns[i];
    while (next + 1 < truth.size() && truth.t_ns[next] < t_ns) ++next;
    const std::size_t before = next == 0 ? 0 : next - 1;
    const double step = static_cast<double>(truth.t_ns[next] - truth.t_ns[before]);
    const double share = step > 0.0 ? std::clamp(static_cast<double>(t_ns - truth.t_ns[before]) / step, 0.0, 1.0) : 0.0;
    out.p_true_m.push_back((1.0 - share) * truth.p_world_tip_m[before] + share * truth.p_world_tip_m[next]);
    out.error_m.push_back(T_true_found * motion.p_world_tip_m[i] - out.p_true_m.back());
  }
  asperity::ClosestPoint at;
  for (std::size_t i = 0; i < n; ++i) {
    const Vector3d p_mesh_m = T_mesh_world * out.p_true_m[i];
    at = at.found() ? surface.bvh.closest_point(p_mesh_m, at) : surface.bvh.closest_point(p_mesh_m);
    const Vector3d normal =
        T_mesh_world.rotation.conjugate() * asperity::foot_along_normal(surface, p_mesh_m, at).normal;
    constexpr std::size_t kReach = 200;
    const Vector3d chord = out.p_true_m[std::min(i + kReach, n - 1)] - out.p_true_m[i > kReach ? i - kReach : 0];
    Vector3d along = chord - chord.dot(normal) * normal;
    if (along.norm() > 0.0) along.normalize();
    out.normal.push_back(normal);
    out.along.push_back(along);
  }
  return out;
}

struct Metrics {
  double correlation = 0.0, length_percent = 0.0, rms_um = 0.0;
};

std::optional<Metrics> metrics_of(const asperity::ProcessResult& result) {
  if (!result.accuracy || !result.accuracy->profile) return std::nullopt;
  const asperity::ProfileComparison& c = *result.accuracy->profile;
  return Metrics{c.correlation, std::abs(c.length_error_percent), c.rms_um};
}

using Case = std::vector<std::optional<Metrics>>;

Case measure_cases(const Options& options, const std::string& surface_name, int seed) {
  const auto number = static_cast<std::uint64_t>(seed);
  asperity::PebbleConfig pebble;
  pebble.seed = seed;
  pebble.facet_m = options.facet_m;
  const asperity::TriangleMesh mesh = asperity::make_pebble(pebble);
  const asperity::MeshSurface surface(mesh);
  asperity::SimulationConfig config = asperity::make_simulation_config(surface_name, "open");
  config.seed = seed;
  config.hand.length_m = 0.095;
  for (double& value : config.tracker.noise_m) value *= options.tracker_noise;
  for (double& value : config.tracker.noise_rad) value *= options.tracker_noise;
  const auto relief = asperity::make_surface(config.surface, number);
  Case out(kCases);
  const auto over_plane = [&] {
    return metrics_of(asperity::process_recording(asperity::simulate_recording(config, *relief), {}));
  };
  out[10] = over_plane();
  asperity::randomise_pose(number, config.shape);
  out[9] = over_plane();

  config.shape.kind = asperity::BaseShapeKind::kMesh;
  config.shape.through = kArc;
  asperity::Scan scan;
  scan.name = surface_name;
  scan.recording = asperity::simulate_recording(config, *relief, mesh);
  const asperity::Recording& recording = *scan.recording;
  const asperity::Pose truth = asperity::true_pose(recording).value();
  const Vector3d middle_m =
      truth * Vector3d(config.shape.centre_m[0], config.shape.centre_m[1], config.shape.centre_m[2]);
  const asperity::Pose guess = asperity::random_motion(5e-3, 5.0 * kDegree, middle_m, number) * truth;
  const asperity::RegisterConfig settings;
  const asperity::ScansOnMesh found = asperity::register_scans({scan}, mesh, guess, settings);
  const asperity::RegisteredScan& registered = found.scans.front();
  out[0] = metrics_of(registered.process);

  const auto measure = [&](asperity::TrajectoryResult trajectory, const asperity::Pose& pose, double bulge) {
    asperity::ProcessResult result;
    result.trajectory = std::move(trajectory);
    asperity::ProcessConfig apart = settings.process;
    apart.profile.merge_passes = false;
    asperity::measure_along(
        recording, apart,
        [&](const asperity::TipMotion& motion) {
          return asperity::base_path_on_mesh(motion, recording.calibration.tip_in_marker_m, surface, pose, apart.base,
                                             bulge);
        },
        result);
    return metrics_of(result);
  };
  const asperity::Pose T_found = found.registration_of(registered).T_mesh_world;
  const MotionError error =
      measure_error(registered.process.trajectory.motion, *recording.truth, truth.inverse() * T_found, surface, truth);
  const auto with = [&](auto part) {
    asperity::TrajectoryResult trajectory = registered.process.trajectory;
    for (std::size_t i = 0; i < trajectory.motion.size(); ++i)
      trajectory.motion.p_world_tip_m[i] = error.p_true_m[i] + part(i);
    return measure(std::move(trajectory), truth, 0.0);
  };
  const auto along_normal = [&](std::size_t i) -> Vector3d {
    return error.normal[i].dot(error.error_m[i]) * error.normal[i];
  };
  out[1] = with(along_normal);
  out[2] = with([&](std::size_t i) -> Vector3d { return error.error_m[i] - along_normal(i); });
  out[3] = with([](std::size_t) -> Vector3d { return Vector3d::Zero(); });

  asperity::ProcessResult begun = asperity::estimate_motion(recording, settings.process);
  out[4] = measure(begun.trajectory, T_found, found.bulge_share);
  out[5] = measure(begun.trajectory, truth, 0.0);
  const Vector3d tip_error_m = recording.calibration.tip_in_marker_m - Vector3d(config.probe.tip_in_marker_m.data());
  for (std::size_t i = 0; i < begun.trajectory.motion.size(); ++i) {
    begun.trajectory.motion.p_world_tip_m[i] -= begun.trajectory.motion.q_world_marker[i] * tip_error_m;
  }
  out[6] = measure(std::move(begun.trajectory), truth, 0.0);
  out[7] = measure(registered.process.trajectory, truth, 0.0);
  out[8] = measure(registered.process.trajectory, T_found, 0.0);
  if (options.each) {
    double sum[3] = {0.0, 0.0, 0.0};
    for (std::size_t i = 0; i < error.error_m.size(); ++i) {
      sum[0] += std::pow(error.normal[i].dot(error.error_m[i]), 2);
      sum[1] += std::pow(error.along[i].dot(error.error_m[i]), 2);
      sum[2] += error.error_m[i].squaredNorm();
    }
    const auto n = static_cast<double>(error.error_m.size());
    std::printf(
        "seed %d: bulge %.2f ± %.2f; error along normal %.3f, path %.3f, across %.3f mm RMS; tip off %.3f %.3f "
        "%.3f, found %.3f %.3f %.3f ± %.3f %.3f %.3f mm\n",
        seed, found.bulge_share, found.bulge_sigma, 1e3 * std::sqrt(sum[0] / n), 1e3 * std::sqrt(sum[1] / n),
        1e3 * std::sqrt(std::max(0.0, sum[2] - sum[1] - sum[0]) / n), -1e3 * tip_error_m[0], -1e3 * tip_error_m[1],
        -1e3 * tip_error_m[2], 1e3 * registered.tip_shift_m[0], 1e3 * registered.tip_shift_m[1],
        1e3 * registered.tip_shift_m[2], 1e3 * registered.tip_sigma_m.value_or(Vector3d::Zero())[0],
        1e3 * registered.tip_sigma_m.value_or(Vector3d::Zero())[1],
        1e3 * registered.tip_sigma_m.value_or(Vector3d::Zero())[2]);
    for (std::size_t k = 0; k < kCases; ++k) {
      if (out[k])
        std::printf("   %-34s %.4f %.3f %% %.2f um\n", kCaseNames[k], out[k]->correlation, out[k]->length_percent,
                    out[k]->rms_um);
    }
    std::fflush(stdout);
  }
  return out;
}

void run(const Options& options) {
  for (const std::string& surface : options.surfaces) {
    std::vector<std::vector<double>> correlation(kCases), length(kCases), rms(kCases);
    for (int seed = 1; seed <= options.seeds; ++seed) {
      const Case cases = measure_cases(options, surface, seed);
      for (std::size_t k = 0; k < kCases; ++k) {
        if (!cases[k]) continue;
        correlation[k].push_back(cases[k]->correlation);
        length[k].push_back(cases[k]->length_percent);
        rms[k].push_back(cases[k]->rms_um);
      }
    }
    std::printf("| %s | correlation | RMS error, µm | length error, %% |\n|---|---|---|---|\n", surface.c_str());
    for (std::size_t k = 0; k < kCases; ++k) {
      if (correlation[k].empty()) continue;
      std::printf("| %s | %.3f (%.3f) | %.1f (%.1f) | %.2f (%.2f) |\n", kCaseNames[k], asperity::median(correlation[k]),
                  *std::min_element(correlation[k].begin(), correlation[k].end()), asperity::median(rms[k]),
                  *std::max_element(rms[k].begin(), rms[k].end()), asperity::median(length[k]),
                  *std::max_element(length[k].begin(), length[k].end()));
    }
    std::fflush(stdout);
  }
}

}  // namespace

int main(int argc, char** argv) {
  try {
    run(parse_options(argc, argv));
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "mesh_loss: %s\n", error.what());
    return 1;
  }
}
