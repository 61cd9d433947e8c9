#include "without_flips.h"

#include <vector>

#include "asperity/base/units.h"
#include "pose_path.h"

namespace asperity {

Recording without_flips(const Recording& recording) {
  constexpr double kNoiseFloor_m = 1e-6;
  const TrackerStream& tracker = recording.tracker;
  if (tracker.size() < 3) return recording;
  PosePath path;
  for (std::size_t i = 0; i < tracker.size(); ++i) {
    path.t_s.push_back(static_cast<double>(tracker.t_ns[i] - tracker.t_ns.front()) * kNanosecond_s);
    path.p_world_tip_m.emplace_back(tracker.T_world_marker[i] * recording.calibration.tip_in_marker_m);
  }
  const std::vector<char> outlying = find_outlying_poses(path, white_noise_m(path).cwiseMax(kNoiseFloor_m));
  const auto keep = [&](auto& column) {
    if (column.size() != outlying.size()) return;  // a column that is not there
    std::size_t kept = 0;
    for (std::size_t i = 0; i < outlying.size(); ++i) {
      if (outlying[i] == 0) column[kept++] = column[i];
    }
    column.resize(kept);
  };
  Recording out = recording;
  keep(out.tracker.t_ns);
  keep(out.tracker.T_world_marker);
  keep(out.tracker.markers);
  keep(out.tracker.reprojection_px);
  for (auto* column : {&out.tracker.sigma_position_m, &out.tracker.sigma_rotation_rad, &out.tracker.noise_position_m,
                       &out.tracker.noise_rotation_rad}) {
    keep(*column);
  }
  return out;
}

}  // namespace asperity
