#include "asperity/profile/unroll_path.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

namespace asperity {

namespace {

constexpr double kPiece_m = 1e-3;  // of hand's path: shorter ones have their heading from the tracker's noise

}  // namespace

std::vector<Eigen::Vector2d> unroll_path(const BasePath& path, std::span<const double> s_m) {
  std::vector<std::size_t> nodes;
  for (std::size_t i = 0; i < path.size(); ++i) {
    if (!std::isfinite(path.s_m[i]) || !path.p_world_m[i].allFinite()) continue;
    if (nodes.empty() || path.s_m[i] >= path.s_m[nodes.back()] + kPiece_m) nodes.push_back(i);
  }
  if (nodes.size() < 3) return {};

  std::vector<Eigen::Vector2d> flat_m{Eigen::Vector2d::Zero()};
  double heading_rad = 0.0;
  Eigen::Vector3d before = Eigen::Vector3d::Zero();
  for (std::size_t k = 0; k + 1 < nodes.size(); ++k) {
    const Eigen::Vector3d piece_m = path.p_world_m[nodes[k + 1]] - path.p_world_m[nodes[k]];
    const Eigen::Vector3d& normal = path.n_world[nodes[k]];
    const Eigen::Vector3d along = piece_m - normal * normal.dot(piece_m);
    if (k > 0) {
      const Eigen::Vector3d from = before - normal * normal.dot(before);
      heading_rad += std::atan2(normal.dot(from.cross(along)), from.dot(along));
    }
    before = piece_m;
    flat_m.emplace_back(flat_m.back() + piece_m.norm() * Eigen::Vector2d(std::cos(heading_rad), std::sin(heading_rad)));
  }

  // As large as the arc length says, which may be that of the surface above the tip's path.
  double chords_m = 0.0;
  for (std::size_t j = 1; j < flat_m.size(); ++j) chords_m += (flat_m[j] - flat_m[j - 1]).norm();
  if (!(chords_m > 0.0)) return {};
  const double arc_m = path.s_m[nodes.back()] - path.s_m[nodes.front()];
  for (Eigen::Vector2d& p_m : flat_m) p_m *= arc_m / chords_m;

  std::vector<Eigen::Vector2d> out;
  out.reserve(s_m.size());
  std::size_t k = 0;
  for (const double s : s_m) {
    while (k + 2 < nodes.size() && path.s_m[nodes[k + 1]] < s) ++k;
    // Before the first and after the last node the end's piece goes on.
    const double from = path.s_m[nodes[k]], to = path.s_m[nodes[k + 1]];
    out.emplace_back(flat_m[k] + (s - from) / (to - from) * (flat_m[k + 1] - flat_m[k]));
  }
  return out;
}

}  // namespace asperity
