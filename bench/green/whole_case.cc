#include "whole_case.h"

#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "asperity/pipeline/true_pose.h"
#include "asperity/simulation/make_surface.h"
#include "asperity/simulation/random_motion.h"
#include "asperity/simulation/randomise_pose.h"
#include "asperity/simulation/simulate_recording.h"

namespace bench {

WholeCase simulate_case(const BodyPool& pool, std::uint64_t seed, std::uint64_t number) {
  using Eigen::Vector3d;
  constexpr std::size_t kPebbles = 8;  // the first of the pool
  constexpr double kDegree = std::numbers::pi / 180.0;
  asperity::Random random(seed, 500000 + number);
  WholeCase out;
  const PreparedBody& body = pool.plain[number % kPebbles];
  const LineOnMesh line =
      walk_over(*body.surface, static_cast<LineKind>(number % 3), random.uniform(60e-3, 160e-3), random);
  asperity::SimulationConfig config = asperity::make_simulation_config("sandpaper", "open");
  config.seed = static_cast<std::int64_t>(1000 * seed + number);
  config.shape.kind = asperity::BaseShapeKind::kMesh;
  constexpr std::size_t kPoints = 7;
  for (std::size_t k = 0; k < kPoints; ++k) {
    const Vector3d& p_m = line.p_m[k * (line.p_m.size() - 1) / (kPoints - 1)];
    config.shape.through += fmt::format("{}{:.6f},{:.6f},{:.6f}", k == 0 ? "" : ";", p_m.x(), p_m.y(), p_m.z());
  }
  asperity::randomise_pose(config.seed, config.shape);
  asperity::Scan scan;
  scan.name = "scan";
  scan.recording = asperity::simulate_recording(
      config, *asperity::make_surface(config.surface, static_cast<std::uint64_t>(config.seed)), body.body.mesh);
  out.as.body = body.body.name;
  out.as.surface = body.surface;
  out.as.T_mesh_world = asperity::true_pose(*scan.recording);
  out.as.lines = {line};
  const Vector3d middle_m = line.p_m[line.p_m.size() / 2];
  constexpr std::array<CaseClass, 3> kKinds{CaseClass::kNear, CaseClass::kNoGuess, CaseClass::kWrongMesh};
  out.as.kind = kKinds[number / 3 % 3];
  if (out.as.kind != CaseClass::kNoGuess) {
    out.as.guess = asperity::random_motion(4e-3, 4.0 * kDegree, middle_m, 77 + number) * *out.as.T_mesh_world;
  }
  if (out.as.kind == CaseClass::kWrongMesh) {
    out.as.surface = pool.plain[(number + 3) % kPebbles].surface;
    out.as.T_mesh_world.reset();
  }
  out.scans = asperity::find_scan_points({scan}, out.as.config);
  for (const asperity::PathPoints& points : out.scans.points) {
    out.as.paths.push_back(points.path);
    out.as.errors.slow_m = std::sqrt(points.path.slow_covariance_world_m2.trace() / 3.0);
  }
  return out;
}

}  // namespace bench
