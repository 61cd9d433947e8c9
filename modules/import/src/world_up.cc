#include "world_up.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>
#include "asperity/import/check_streams.h"

namespace asperity {

std::string up_of(const ImportTables& tables, const MappingConfig& config) {
  return config.up.empty() ? tables.pose->preset.up : config.up;
}

void find_up(const ImportTables& tables, const MappingConfig& config, ImportedMotion& motion) {
  motion.up = up_of(tables, config);
  const bool doubtful = !motion.checks.doubts.empty();
  const auto estimate = estimate_up(motion.streams);
  constexpr double kNearAxis_rad = 0.35;   // 20°
  constexpr double kOnAxis_rad = 0.08727;  // 5°: what offsets of a sensor and a hand's mean acceleration make
  Eigen::Vector3d up = Eigen::Vector3d::UnitZ();
  if (!motion.up.empty()) {
    up = axis_vector(motion.up, "the world's axis that points up");
    if (!estimate) return turn_world(motion.streams.pose, up), turn_world(motion.object, up);
    motion.up_angle_rad = std::acos(std::clamp(estimate->direction.dot(up), -1.0, 1.0));
    if (motion.up_angle_rad > kOnAxis_rad && motion.up_angle_rad <= kNearAxis_rad && !doubtful) {
      motion.checks.notes.push_back(fmt::format(
          "world: the mean specific force is {:.1f}° from {}; if the world is tilted, leave out what points up (--up)",
          motion.up_angle_rad * 57.29577951308232, motion.up));
    }
    if (motion.up_angle_rad > kNearAxis_rad && !doubtful) {
      motion.checks.doubts.push_back(
          {ColumnGroup::kRotation,
           FileRole::kPose,
           fmt::format(
               "the world's {} is {} to point up, but the mean specific force in the world points {:.0f}° away from "
               "it, along {}",
               motion.up, config.up.empty() ? "taken by the preset" : "stated", motion.up_angle_rad * 57.29577951308232,
               estimate->name),
           {},
           {{"mapping.up", estimate->name}}});
    }
  } else {
    motion.up_is_estimated = true;
    motion.up_is_assumed = doubtful || !estimate;
    motion.up = estimate ? estimate->name : "z";
    up = axis_vector(motion.up, "up");
    motion.up_angle_rad = estimate ? estimate->angle_rad : 0.0;
    // A world that no axis of points up is turned by the direction itself.
    if (estimate && estimate->angle_rad > (doubtful ? kNearAxis_rad : kOnAxis_rad)) {
      up = estimate->direction;
      motion.up = fmt::format("({:.3f}, {:.3f}, {:.3f})", up.x(), up.y(), up.z());
    }
  }
  turn_world(motion.streams.pose, up);
  turn_world(motion.object, up);
}

}  // namespace asperity
