// Twelve scans of a pebble, three surfaces, between which the object was moved once, registered from scratch by one
// call: which scans it puts into one placement, how far the poses are off beside their standard deviations, and the
// processor time of each step.
//
//   many_scans [--seeds N] [--scans 12] [--moved yes|no] [--surfaces sandpaper,protoboard,clay_pot]

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <exception>
#include <numbers>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "asperity/pipeline/locate_scans.h"
#include "asperity/pipeline/register_scans.h"
#include "asperity/pipeline/scan_points.h"
#include "asperity/pipeline/true_pose.h"
#include "asperity/registration/pose_error.h"
#include "asperity/simulation/make_pebble.h"
#include "asperity/simulation/make_surface.h"
#include "asperity/simulation/random_motion.h"
#include "asperity/simulation/simulate_recording.h"
#include "read_options.h"

namespace {

struct Options {
  int seeds = 3;
  int scans = 12;
  bool moved = true;
  std::vector<std::string> surfaces{"sandpaper", "protoboard", "clay_pot"};
};

Options parse_options(int argc, char** argv) {
  Options out;
  bench::read_options(
      argc, argv,
      {{"--seeds", [&](auto value) { out.seeds = bench::seed_count(value); }},
       {"--scans", [&](auto value) { out.scans = static_cast<int>(bench::number_within(value, 1, 100)); }},
       {"--moved", [&](auto value) { out.moved = bench::is_first(value, "yes", "no"); }},
       {"--surfaces", [&](auto value) { out.surfaces = bench::split_list(value); }}});
  return out;
}

double processor_s() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

// Arcs over the upper side, each in a direction of its own, bent to one side.
std::string arc(int scan) {
  const double turn = 2.4 * scan;
  std::string out;
  for (int k = -2; k <= 2; ++k) {
    const double along = 0.45 * k, aside = 0.25 - 0.12 * k * k;
    const double x = std::cos(turn) * along - std::sin(turn) * aside,
                 y = std::sin(turn) * along + std::cos(turn) * aside;
    const double z = std::sqrt(std::max(0.05, 1.0 - x * x - y * y));
    out += (out.empty() ? "" : ";") + std::to_string(0.045 * x) + "," + std::to_string(0.036 * y) + "," +
           std::to_string(0.028 * z);
  }
  return out;
}

// Where the pebble stands: its z axis along the bench's normal; the second time moved by 20 mm and 100 degrees.
asperity::Pose place(bool second) {
  const Eigen::Vector3d normal(0.0, -0.9397, -0.3420);
  asperity::Pose out{asperity::shortest_rotation(Eigen::Vector3d::UnitZ(), normal),
                     Eigen::Vector3d(0.0, 0.06, 0.35) - 0.028 * normal};
  if (!second) return out;
  const Eigen::Quaterniond turn(Eigen::AngleAxisd(1.75, (normal + Eigen::Vector3d(0.2, 0.1, 0.0)).normalized()));
  return {turn * out.rotation, out.translation_m + Eigen::Vector3d(0.015, -0.004, 0.012)};
}

asperity::Scan simulate(const Options& options, const asperity::TriangleMesh& mesh, int seed, int scan) {
  const std::string& surface = options.surfaces[static_cast<std::size_t>(scan) % options.surfaces.size()];
  asperity::SimulationConfig config = asperity::make_simulation_config(surface, "open");
  config.seed = 1000 * seed + scan;
  config.shape.kind = asperity::BaseShapeKind::kMesh;
  config.shape.through = arc(scan);
  config.shape.mesh_pose = asperity::MeshPose::kGiven;
  const asperity::Pose T_world_mesh = place(options.moved && scan >= options.scans / 2);
  const Eigen::Vector3d turn = asperity::log_rotation(T_world_mesh.rotation);
  for (std::size_t k = 0; k < 3; ++k) {
    config.shape.mesh_position_m[k] = T_world_mesh.translation_m[static_cast<Eigen::Index>(k)];
    config.shape.mesh_rotation_rad[k] = turn[static_cast<Eigen::Index>(k)];
  }
  asperity::Scan out;
  out.name = surface + std::to_string(scan + 1);
  out.recording = asperity::simulate_recording(
      config, *asperity::make_surface(config.surface, static_cast<std::uint64_t>(config.seed)), mesh);
  return out;
}

void run(const Options& options) {
  std::printf(
      "| seed | placements found | of the scans | points moved, mm | its σ | rotated, ° | its σ | crossings | shifts | "
      "trajectories, s | registration, s | all, s |\n|---|---|---|---|---|---|---|---|---|---|---|---|\n");
  for (int seed = 1; seed <= options.seeds; ++seed) {
    asperity::PebbleConfig pebble;
    pebble.seed = seed;
    const asperity::TriangleMesh mesh = asperity::make_pebble(pebble);
    std::vector<asperity::Scan> scans;
    for (int k = 0; k < options.scans; ++k) scans.push_back(simulate(options, mesh, seed, k));
    const asperity::RegisterConfig config;
    const double begin_s = processor_s();
    const asperity::ScanPoints points = asperity::find_scan_points(scans, config);
    const double points_s = processor_s();
    const asperity::MeshSurface surface(mesh);
    (void)asperity::locate_scans(points, surface, {}, config);
    const double located_s = processor_s();
    const asperity::ScansOnMesh result = asperity::register_scans(scans, mesh, {}, config);
    const double end_s = processor_s();
    std::string groups;
    for (const asperity::RegisteredScan& scan : result.scans) groups += std::to_string(scan.placement + 1);
    double error_m = 0.0, sigma_m = 0.0, turn_rad = 0.0, sigma_rad = 0.0;
    for (std::size_t k = 0; k < scans.size(); ++k) {
      const asperity::RegisteredScan& scan = result.scans[k];
      if (scan.path.size() == 0) continue;
      const asperity::PoseError error = asperity::pose_error(
          result.registration_of(scan), *asperity::true_pose(*scans[k].recording), scan.path.p_mesh_m);
      error_m = std::max(error_m, error.rms_m);
      turn_rad = std::max(turn_rad, error.rotation_rad);
      sigma_m = std::max(sigma_m, error.sigma_m);
      sigma_rad = std::max(sigma_rad, error.sigma_rad);
    }
    constexpr double kDegree = std::numbers::pi / 180.0;
    std::printf("| %d | %zu | %s | %.3f | %.3f | %.2f | %.2f | %zu | %zu | %.1f | %.1f | %.1f |\n", seed,
                result.placements.size(), groups.c_str(), 1e3 * error_m, 1e3 * sigma_m, turn_rad / kDegree,
                sigma_rad / kDegree, result.crossings, result.matched_shifts, points_s - begin_s, located_s - points_s,
                end_s - located_s);
    std::fflush(stdout);
  }
}

}  // namespace

int main(int argc, char** argv) {
  try {
    run(parse_options(argc, argv));
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "many_scans: %s\n", error.what());
    return 1;
  }
}
