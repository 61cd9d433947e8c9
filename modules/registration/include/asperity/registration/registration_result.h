#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "asperity/base/problem.h"
#include "asperity/geometry/pose.h"

namespace asperity {

// A scan path as registration expects it, world frame. `outward_world` is empty or holds, for each point, the
// direction from the surface towards the probe; `sigma_m` is the standard deviation of a point along the
// surface's normal, 0 if unknown; `slow_covariance_world_m2` that of the part of the positions' error that lasts over
// many points, zero if unknown. `q_world_marker` is empty or the probe's orientation at each point: with it and
// `tip_sigma_m`, the standard deviation of the tip's calibrated position (marker axes; 0: exact or unknown), that
// position is an unknown of the fit. Paths with the same number `tip` share it.
struct MeasuredPath {
  std::vector<Eigen::Vector3d> p_world_m;
  std::vector<Eigen::Vector3d> outward_world;
  double sigma_m = 0.0;
  Eigen::Matrix3d slow_covariance_world_m2 = Eigen::Matrix3d::Zero();
  std::vector<Eigen::Quaterniond> q_world_marker;
  Eigen::Vector3d tip_sigma_m = Eigen::Vector3d::Zero();
  int tip = 0;
};

enum class StopRule { kErrorChange, kPoseChange, kStalled, kIterationLimit };
inline constexpr std::array<std::string_view, 4> kStopRuleNames{"error_change", "pose_change", "stalled",
                                                                "iteration_limit"};

// A motion of the path over the mesh that changes the distances too little to be determined.
struct UndeterminedMotion {
  Eigen::Vector3d rotation_rad = Eigen::Vector3d::Zero();  // about `centre_mesh_m`
  Eigen::Vector3d shift_m = Eigen::Vector3d::Zero();       // both scaled so that points move 1 m RMS
  Eigen::Vector3d centre_mesh_m = Eigen::Vector3d::Zero();
  double sigma_m = 0.0;     // standard deviation of the points' RMS motion along it
  std::string description;  // in words: "slides along (0.00, 1.00, 0.00)"
};

// Another pose at which the path fits the mesh.
struct RunnerUp {
  Pose T_mesh_world;
  double rms_m = 0.0;         // residual there
  double distance_m = 0.0;    // RMS distance of the path's points between the two poses
  double rotation_rad = 0.0;  // angle between the two
};

// The errors of paths for which none are stated, as their heights over the mesh show them (estimate_drift.h).
struct AssumedDrift {
  double sigma_m = 0.0;   // standard deviation per axis; 0: the points are no path, their errors are independent
  double length_m = 0.0;  // of path over which it lasts
};

// What keeps the paths from the mesh, and from the guess (pose_misfit.h); nan: not known.
struct PoseMisfit {
  double slow_m = std::numeric_limits<double>::quiet_NaN();         // of the distances, over centimetres of path, RMS
  double relief_m = std::numeric_limits<double>::quiet_NaN();       // the rest of them, RMS
  double explained_m = std::numeric_limits<double>::quiet_NaN();    // of slow_m, by all known errors, RMS
  double extent_m = std::numeric_limits<double>::quiet_NaN();       // RMS distance of the points from their mean
  double off_share = 0.0;                                           // of the points, that are not over the mesh:
  double off_limit_m = std::numeric_limits<double>::quiet_NaN();    // farther than this over centimetres, and
  double off_m = std::numeric_limits<double>::quiet_NaN();          // this in the median of those
  double guess_shift_m = std::numeric_limits<double>::quiet_NaN();  // of the points' mean from where the guess has it
  double guess_rotation_rad = std::numeric_limits<double>::quiet_NaN();
  double guess_sigma_m = std::numeric_limits<double>::quiet_NaN();  // as the settings state the guess's error
  double guess_sigma_rad = std::numeric_limits<double>::quiet_NaN();
  bool guess_stated = true;  // these are the user's word, not a default
};

// The size of the object over that of the mesh, as the paths show it (mesh_scale.h); nan: not known.
struct MeshScale {
  double ratio = std::numeric_limits<double>::quiet_NaN();
  double sigma = std::numeric_limits<double>::quiet_NaN();  // standard error of its logarithm
  double gain = std::numeric_limits<double>::quiet_NaN();   // of −2 log likelihood over the mesh as it is
};

// What speaks against a pose (pose_rivals.h); nan: not known.
struct PoseRivals {
  bool judged = false;                                         // the rest is known
  bool searched = false;                                       // poses everywhere on the mesh were compared
  double odds = 0.0;                                           // of all other poses together to this one
  double log_odds = -std::numeric_limits<double>::infinity();  // its logarithm, where odds are too small for a number
  std::optional<RunnerUp> rival;                               // the likeliest of these, however unlikely
  std::size_t symmetric_copies = 0;                            // poses that the mesh's own symmetry maps onto this one
  bool symmetric_motion = false;  // the mesh maps onto itself along a motion that the paths leave open
  double sigma_m = std::numeric_limits<double>::quiet_NaN();     // of the points' RMS position, and of the rotation,
  double sigma_rad = std::numeric_limits<double>::quiet_NaN();   // these motions left out
  double slow_ratio = std::numeric_limits<double>::quiet_NaN();  // of the drift that the pose needs to the stated drift
  double slow_ratio_sigma = std::numeric_limits<double>::quiet_NaN();  // standard error of its logarithm
  double outlying = std::numeric_limits<double>::quiet_NaN();          // share of the paths that no such error explains
  // That on a mesh of another object the best of the poses would stand out of the others as this one does.
  double chance = std::numeric_limits<double>::quiet_NaN();
  // Logarithm of the odds of the mesh's mirror image to the mesh, the paths in the same place (mirror_image.h).
  double mirror_log_odds = std::numeric_limits<double>::quiet_NaN();
  MeshScale scale;
};

// The position of a scan path on a mesh.
struct RegistrationResult {
  Pose T_mesh_world;
  double rms_m = 0.0;   // root mean square distance of the inliers to the surface
  double mean_m = 0.0;  // mean distance of all points (the thesis's measure, §5.4)
  std::size_t points = 0;
  std::size_t outliers = 0;
  int iterations = 0;
  bool converged = false;
  StopRule stopped_by = StopRule::kIterationLimit;
  Eigen::Matrix<double, 6, 6> covariance = Eigen::Matrix<double, 6, 6>::Zero();  // of (rotation rad, shift m) about
  Eigen::Vector3d centre_mesh_m = Eigen::Vector3d::Zero();                       // the points' mean, mesh frame
  std::vector<UndeterminedMotion> undetermined;
  std::optional<RunnerUp> runner_up;
  PoseMisfit misfit;
  PoseRivals rivals;
  std::optional<AssumedDrift> assumed;  // of paths without stated errors, the largest; absent: all are stated
  bool ambiguous = false;               // the runner-up fits as well
  bool trustworthy = true;
  std::string verdict;  // in words
  Problems problems;
};

}  // namespace asperity
