#include "scan/kept_rows.h"

#include <algorithm>

namespace asperity::studio {

namespace {

template <class Rows>
auto first_from(const Rows& rows, std::int64_t t_ns) {
  return std::lower_bound(rows.begin(), rows.end(), t_ns,
                          [](const auto& row, std::int64_t limit_ns) { return row.t_ns < limit_ns; });
}

}  // namespace

void KeptRows::add(std::span<const ProbeSample> rows) {
  // A recording's rows rise in time; what does not is not stored either.
  for (const ProbeSample& row : rows) {
    if (rows_.empty() || row.t_ns > rows_.back().t_ns) rows_.push_back(row);
  }
  if (rows_.empty()) return;
  const std::int64_t trail_ns = rows_.back().t_ns - kTrail_ns;
  while (rows_.size() > kMostRows || (!held_ && rows_.front().t_ns < trail_ns)) {
    dropped_until_ns_ = rows_.front().t_ns;
    rows_.pop_front();
  }
  while (!poses_.empty() && poses_.front().t_ns < rows_.front().t_ns - kTrail_ns) poses_.pop_front();
}

void KeptRows::add(const TrackerSample& pose) {
  if (poses_.empty() || pose.t_ns > poses_.back().t_ns) poses_.push_back(pose);
  if (poses_.size() > kMostRows) poses_.pop_front();
}

void KeptRows::forget_before(std::int64_t t_ns) {
  rows_.erase(rows_.begin(), first_from(rows_, t_ns));
  poses_.erase(poses_.begin(), first_from(poses_, t_ns));
  dropped_until_ns_ = std::max(dropped_until_ns_, t_ns - 1);
}

void KeptRows::replay(std::int64_t start_ns, std::int64_t end_ns, const std::function<void(const ProbeSample&)>& on_row,
                      const std::function<void(const TrackerSample&)>& on_pose) const {
  auto pose = first_from(poses_, start_ns);
  for (auto row = first_from(rows_, start_ns); row != rows_.end() && row->t_ns <= end_ns; ++row) {
    for (; pose != poses_.end() && pose->t_ns <= row->t_ns; ++pose) on_pose(*pose);
    on_row(*row);
  }
  for (; pose != poses_.end() && pose->t_ns <= end_ns; ++pose) on_pose(*pose);
}

void KeptRows::copy(std::int64_t start_ns, std::int64_t end_ns, bool has_gyro, Recording& out) const {
  replay(
      start_ns, end_ns,
      [&](const ProbeSample& row) {
        out.probe.t_ns.push_back(row.t_ns);
        out.probe.accel_counts.push_back(row.accel_counts);
        out.probe.force_counts.push_back(row.force_counts);
        if (has_gyro) out.probe.gyro_counts.push_back(row.gyro_counts);
      },
      [&](const TrackerSample& pose) {
        out.tracker.t_ns.push_back(pose.t_ns);
        out.tracker.T_world_marker.push_back(pose.T_world_marker);
        out.tracker.markers.push_back(pose.markers);
        out.tracker.reprojection_px.push_back(pose.reprojection_px);
        out.tracker.sigma_position_m.push_back(pose.sigma_position_m);
        out.tracker.sigma_rotation_rad.push_back(pose.sigma_rotation_rad);
      });
}

}  // namespace asperity::studio
