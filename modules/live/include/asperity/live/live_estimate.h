#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "asperity/profile/find_base_path.h"

namespace asperity {

// Where the tip was, every few milliseconds, in the air too.
struct LiveTip {
  std::int64_t t_ns = 0;  // of the probe's clock on the host
  Eigen::Vector3d p_world_tip_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d v_world_tip_mps = Eigen::Vector3d::Zero();
  Eigen::Vector3d heading_world = Eigen::Vector3d::Zero();     // unit direction of travel; zero: none yet
  Eigen::Vector3d probe_axis_world = Eigen::Vector3d::Zero();  // unit, from the tip to the hand
  double sigma_m = 0.0;                                        // of the position, largest axis
  double speed_mps = 0.0;                                      // along the path
  double force_N = std::numeric_limits<double>::quiet_NaN();
  double tilt_rad = std::numeric_limits<double>::quiet_NaN();  // probe's axis from the base's normal; nan: no base yet
  double s_m = 0.0;
  bool contact = false;
  bool usable = false;  // in contact, certain and fast enough: it enters the profile
};

// A point of the growing profile, one for each multiple of the spacing that the arc length passes, as in profile.h.
// All numbers but t_ns and s_m are nan where the profile has a gap.
struct LivePoint {
  std::int64_t t_ns = 0;  // when the tip was there
  double s_m = 0.0;
  double height_m = 0.0;
  double sigma_m = 0.0;
  double texture_m = 0.0;
  double force_N = 0.0;
  double speed_mps = 0.0;
};

// The base shape in use.
struct LiveBase {
  bool known = false;  // false: only the probe's axis stands in for the normal
  PathShape shape = PathShape::kPlane;
  Eigen::Vector3d normal_world = Eigen::Vector3d::Zero();  // outward, where the tip is; zero: nothing yet
  double normal_sigma_deg = 0.0;
  double radius_m = 0.0;  // circle
  bool settled = false;   // it has been fitted to ten windows of travel or more
};

// What was passed over, since the start.
struct LiveCounts {
  std::uint64_t rows = 0;
  std::uint64_t rows_refused = 0;  // out of order, repeated or not finite
  std::uint64_t rows_lost = 0;     // by the gaps between rows and the probe's rate
  std::uint64_t poses = 0;
  std::uint64_t poses_refused = 0;   // out of order, repeated, not finite
  std::uint64_t poses_late = 0;      // older than the estimate reaches back
  std::uint64_t poses_outlying = 0;  // far from the probe's motion
  std::uint64_t restarts = 0;        // of the estimate, after a hole in the data
};

// What is new since the last call.
struct LiveEstimate {
  std::vector<LiveTip> tips;
  std::vector<LivePoint> points;
  LiveBase base;
  LiveCounts counts;
  bool calibrated = true;              // false: nothing can be estimated
  std::string waiting;                 // why there is no motion yet, for a person; empty: there is
  std::int64_t newest_row_ns = 0;      // of the probe
  std::int64_t newest_pose_ns = 0;     // its true time: the latency is taken off
  std::int64_t motion_ns = 0;          // up to here the motion is in tips and points
  double age_s = 0.0;                  // of motion_ns against newest_row_ns: how far the profile is behind the probe
  double texture_group_delay_m = 0.0;  // of texture_m's high-pass, at four times its cut-off
};

}  // namespace asperity
