#include "asperity/registration/register_thesis.h"

#include <cmath>

#include <fmt/format.h>

#include "asperity/base/error.h"
#include "asperity/registration/absolute_orientation.h"

namespace asperity {
namespace {

constexpr double kMostSpacings = 1e7;

// The path at equal distances along its chords, its first point first.
void resample_path(const MeasuredPath& path, std::size_t index, double spacing_m, std::vector<Eigen::Vector3d>& out) {
  double length_m = 0.0;
  for (std::size_t i = 0; i < path.p_world_m.size(); ++i) {
    if (!path.p_world_m[i].allFinite()) {
      throw Error(fmt::format("registration: path {}, point {} is not finite", index, i));
    }
    if (i > 0) length_m += (path.p_world_m[i] - path.p_world_m[i - 1]).norm();
  }
  if (length_m > kMostSpacings * spacing_m) {
    throw Error(
        fmt::format("registration: path {} is {} m long: too many spacings of {} m", index, length_m, spacing_m));
  }
  if (path.p_world_m.empty()) return;
  out.push_back(path.p_world_m.front());
  double to_next_m = spacing_m;
  for (std::size_t i = 1; i < path.p_world_m.size(); ++i) {
    const Eigen::Vector3d& a = path.p_world_m[i - 1];
    const double step_m = (path.p_world_m[i] - a).norm();
    for (; to_next_m <= step_m; to_next_m += spacing_m) out.push_back(lerp(a, path.p_world_m[i], to_next_m / step_m));
    to_next_m -= step_m;
  }
}

}  // namespace

RegistrationResult register_thesis(std::span<const MeasuredPath> paths, const MeshBvh& bvh, const Pose& guess,
                                   const ThesisRegistrationConfig& config) {
  std::vector<Eigen::Vector3d> world_m;
  for (std::size_t k = 0; k < paths.size(); ++k) resample_path(paths[k], k, config.spacing_m, world_m);
  if (world_m.size() < 3) {
    throw Error(fmt::format("registration: {} points at equal distances of {} m; three are needed", world_m.size(),
                            config.spacing_m));
  }
  RegistrationResult out;
  out.T_mesh_world = guess;
  out.points = world_m.size();
  std::vector<ClosestPoint> closest(world_m.size());
  std::vector<Eigen::Vector3d> on_mesh_m(world_m.size());
  const auto project = [&] {
    double square = 0.0;
    out.mean_m = 0.0;
    for (std::size_t i = 0; i < world_m.size(); ++i) {
      const Eigen::Vector3d p_m = out.T_mesh_world * world_m[i];
      closest[i] = closest[i].found() ? bvh.closest_point(p_m, closest[i]) : bvh.closest_point(p_m);
      if (!closest[i].found()) throw Error("registration: the guess is not a finite pose");
      on_mesh_m[i] = closest[i].p_m;
      out.mean_m += closest[i].distance_m;
      square += closest[i].distance_m * closest[i].distance_m;
    }
    out.mean_m /= static_cast<double>(world_m.size());
    out.rms_m = std::sqrt(square / static_cast<double>(world_m.size()));
  };
  project();
  while (out.iterations < config.max_iterations && !out.converged) {
    const double before_m = out.mean_m;
    out.T_mesh_world = absolute_orientation(world_m, on_mesh_m).T_b_a;
    ++out.iterations;
    project();
    out.converged = std::abs(before_m - out.mean_m) <= config.relative_change * before_m;
  }
  out.stopped_by = out.converged ? StopRule::kErrorChange : StopRule::kIterationLimit;
  out.trustworthy = out.converged;
  for (const Eigen::Vector3d& p_m : world_m) out.centre_mesh_m += out.T_mesh_world * p_m;
  out.centre_mesh_m /= static_cast<double>(world_m.size());
  out.verdict = fmt::format("{} after {} iterations: mean distance {:.4f} mm, {:.4f} mm RMS, of {} points.",
                            out.converged ? "the error no longer changes" : "iteration limit", out.iterations,
                            1e3 * out.mean_m, 1e3 * out.rms_m, out.points);
  return out;
}

}  // namespace asperity
