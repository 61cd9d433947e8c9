#include "sample_intake.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "fused_setup.h"

namespace asperity {

namespace {

constexpr std::int64_t kNever_ns = -4'000'000'000'000'000'000;  // differences of times do not overflow
constexpr int kClockSetBack = 50;                               // rows or poses before the newest, in a row
constexpr std::size_t kMostRows = 50'000;
constexpr std::size_t kMostPoses = 5'000;
constexpr double kLargestCount = 1e10;  // beyond any converter
constexpr std::int64_t kPoseAhead_ns = 1'000'000'000;

template <class T>
void drop_front(std::vector<T>& x, std::size_t count) {
  x.erase(x.begin(), x.begin() + static_cast<std::ptrdiff_t>(std::min(count, x.size())));
}

bool believable(const Eigen::Vector3d& counts) {
  return counts.allFinite() && counts.cwiseAbs().maxCoeff() < kLargestCount;
}

bool believable_time(std::int64_t t_ns) { return t_ns > kNever_ns && t_ns < -kNever_ns; }

}  // namespace

SampleIntake::SampleIntake(const Calibration& calibration, const RecordingInfo& info)
    : latency_ns_(std::llround(inertial_smoother::prior_latency_s(calibration) * 1e9)),
      newest_row_ns_(kNever_ns),
      newest_pose_ns_(kNever_ns),
      begin_ns_(kNever_ns) {
  recording_.calibration = calibration;
  recording_.info = info;
}

SampleIntake::Row SampleIntake::judge(const ProbeSample& row, double max_gap_s) {
  ++counts_.rows;
  const bool sound = believable_time(row.t_ns) && believable(row.accel_counts);
  const bool first = newest_row_ns_ == kNever_ns;
  if (sound && !first && row.t_ns <= newest_row_ns_) {
    ++counts_.rows_refused;
    if (row.t_ns == newest_row_ns_ || ++rows_back_ < kClockSetBack) return Row::kRefused;
    rows_back_ = 0;
    return Row::kAfterHole;
  }
  if (!sound || recording_.probe.size() >= kMostRows) {
    ++counts_.rows_refused;
    return Row::kRefused;
  }
  rows_back_ = 0;
  if (first) return Row::kNext;
  const double gap_s = static_cast<double>(row.t_ns - newest_row_ns_) * 1e-9;
  if (gap_s > max_gap_s) return Row::kAfterHole;
  const double periods = gap_s * recording_.info.probe_rate_Hz;
  if (periods > 1.6) counts_.rows_lost += static_cast<std::uint64_t>(std::lround(periods) - 1);
  return Row::kNext;
}

void SampleIntake::add(const ProbeSample& row) {
  ProbeStream& probe = recording_.probe;
  newest_row_ns_ = row.t_ns;
  probe.t_ns.push_back(row.t_ns);
  probe.accel_counts.push_back(row.accel_counts);
  probe.force_counts.push_back(std::abs(row.force_counts) < kLargestCount ? row.force_counts
                                                                          : std::numeric_limits<double>::quiet_NaN());
  if (!recording_.calibration.gyroscope) return;
  // A probe without a gyroscope leaves the field as it was made.
  const Eigen::Vector3d none = Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
  const bool reads = believable(row.gyro_counts);
  has_gyro_ = has_gyro_ || (reads && !row.gyro_counts.isZero(0.0));
  if (!has_gyro_) return;
  probe.gyro_counts.resize(probe.size() - 1, none);
  probe.gyro_counts.push_back(reads ? row.gyro_counts : none);
}

void SampleIntake::add(const TrackerSample& pose) {
  ++counts_.poses;
  const double norm = pose.T_world_marker.rotation.norm();
  const bool sound = believable_time(pose.t_ns) && pose.T_world_marker.translation_m.allFinite() &&
                     pose.T_world_marker.translation_m.norm() < 1e3 && norm > 0.5 && norm < 2.0;
  if (!sound) {
    ++counts_.poses_refused;
    return;
  }
  const std::int64_t t_ns = pose.t_ns - latency_ns_;
  if (newest_row_ns_ != kNever_ns && t_ns > newest_row_ns_ + kPoseAhead_ns) {
    ++counts_.poses_refused;
    return;
  }
  if (t_ns <= newest_pose_ns_) {
    ++counts_.poses_refused;
    if (t_ns == newest_pose_ns_ || ++poses_back_ < kClockSetBack) return;
    clear_poses();
  }
  poses_back_ = 0;
  newest_pose_ns_ = t_ns;
  if (t_ns <= begin_ns_) {
    ++counts_.poses_late;
    return;
  }
  TrackerStream& tracker = recording_.tracker;
  if (tracker.size() >= kMostPoses) {
    drop_front(tracker.t_ns, kMostPoses / 2);
    drop_front(tracker.T_world_marker, kMostPoses / 2);
    drop_front(tracker.sigma_position_m, kMostPoses / 2);
    drop_front(tracker.sigma_rotation_rad, kMostPoses / 2);
    drop_front(tracker.noise_position_m, kMostPoses / 2);
    drop_front(tracker.noise_rotation_rad, kMostPoses / 2);
  }
  tracker.t_ns.push_back(t_ns);
  Pose sane = pose.T_world_marker;
  sane.rotation.normalize();
  tracker.T_world_marker.push_back(sane);
  tracker.sigma_position_m.push_back(pose.sigma_position_m);
  tracker.sigma_rotation_rad.push_back(pose.sigma_rotation_rad);
  tracker.noise_position_m.push_back(pose.noise_position_m);
  tracker.noise_rotation_rad.push_back(pose.noise_rotation_rad);
}

void SampleIntake::clear_rows() {
  recording_.probe = {};
  begin_ns_ = kNever_ns;
}

void SampleIntake::clear_poses() {
  recording_.tracker = {};
  newest_pose_ns_ = kNever_ns;
}

void SampleIntake::forget_before(std::int64_t t_ns) {
  ProbeStream& probe = recording_.probe;
  const auto rows =
      static_cast<std::size_t>(std::lower_bound(probe.t_ns.begin(), probe.t_ns.end(), t_ns) - probe.t_ns.begin());
  drop_front(probe.t_ns, rows);
  drop_front(probe.accel_counts, rows);
  drop_front(probe.force_counts, rows);
  drop_front(probe.gyro_counts, rows);
  TrackerStream& tracker = recording_.tracker;
  const auto poses =
      static_cast<std::size_t>(std::lower_bound(tracker.t_ns.begin(), tracker.t_ns.end(), t_ns) - tracker.t_ns.begin());
  drop_front(tracker.t_ns, poses);
  drop_front(tracker.T_world_marker, poses);
  drop_front(tracker.sigma_position_m, poses);
  drop_front(tracker.sigma_rotation_rad, poses);
  drop_front(tracker.noise_position_m, poses);
  drop_front(tracker.noise_rotation_rad, poses);
}

std::vector<double> SampleIntake::pose_s(std::int64_t origin_ns) const {
  std::vector<double> out;
  out.reserve(recording_.tracker.size());
  for (const std::int64_t t_ns : recording_.tracker.t_ns) out.push_back(static_cast<double>(t_ns - origin_ns) * 1e-9);
  return out;
}

}  // namespace asperity
