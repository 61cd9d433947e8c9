#include "align/scan_overlaps.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <map>

#include <Eigen/Core>

#include "align/align_scene.h"

namespace asperity::studio {

namespace {

using Cell = std::array<std::int64_t, 3>;

Cell cell_of(const Eigen::Vector3d& p_m, double size_m) {
  return {static_cast<std::int64_t>(std::floor(p_m.x() / size_m)),
          static_cast<std::int64_t>(std::floor(p_m.y() / size_m)),
          static_cast<std::int64_t>(std::floor(p_m.z() / size_m))};
}

// A point of one scan.
struct ScanPoint {
  std::size_t scan;
  Eigen::Vector3d p_m;
};

}  // namespace

double overlap_reach_m(const AlignScene& scene) {
  const RegisterConfig config = config_of(scene.of);
  return config.refinement.overlap_m + config.points.spacing_m;
}

std::vector<std::uint8_t> scan_overlaps(const AlignScene& scene, const std::vector<Pose>& T_mesh_world) {
  std::vector<std::uint8_t> out(scene.p_world_m.size(), 0);
  if (scene.scans.points.size() < 2) return out;
  const double reach_m = overlap_reach_m(scene);
  const auto placed = [&](std::size_t scan, const Eigen::Vector3d& p_world_m) {
    return T_mesh_world.empty() ? p_world_m : Eigen::Vector3d(T_mesh_world[scan] * p_world_m);
  };
  std::map<Cell, std::vector<ScanPoint>> cells;
  for (std::size_t k = 0; k < scene.scans.points.size(); ++k) {
    for (const Eigen::Vector3d& p_world_m : scene.scans.points[k].path.p_world_m) {
      if (!p_world_m.allFinite()) continue;
      const Eigen::Vector3d p_m = placed(k, p_world_m);
      cells[cell_of(p_m, reach_m)].push_back({k, p_m});
    }
  }
  const auto is_near_another = [&](std::size_t scan, const Eigen::Vector3d& p_m) {
    const Cell centre = cell_of(p_m, reach_m);
    for (std::int64_t i = 0; i < 27; ++i) {
      const auto found = cells.find({centre[0] + i % 3 - 1, centre[1] + i / 3 % 3 - 1, centre[2] + i / 9 - 1});
      if (found == cells.end()) continue;
      for (const ScanPoint& other : found->second) {
        if (other.scan != scan && (other.p_m - p_m).squaredNorm() <= reach_m * reach_m) return true;
      }
    }
    return false;
  };
  for (std::size_t i = 0; i < out.size(); ++i) {
    if (is_near_another(scene.path[i], placed(scene.path[i], scene.p_world_m[i]))) out[i] = kNearScan;
  }
  return out;
}

}  // namespace asperity::studio
