#pragma once

#include <cstdint>
#include <deque>
#include <limits>

#include <Eigen/Core>

#include "asperity/geometry/pose.h"
#include "asperity/recording/calibration.h"

namespace asperity {

// When the probe counts as stationary.
struct RestConfig {
  double window_s = 0.25;
  double acceleration_mps2 = 0.5;
  double position_m = 0.001;
  double rotation_rad = 0.02;
  double magnitude_tolerance = 0.1;

  template <class V>
  void visit(V& v) {
    v.field("window_s", window_s, "length of the stretches that are judged, s", {0.05, 10.0});
    v.field("acceleration_mps2", acceleration_mps2,
            "deviation of the acceleration on each axis while stationary, at most, m/s^2", {0.0, 100.0});
    v.field("position_m", position_m, "deviation of the position on each axis while stationary, at most, m",
            {0.0, 1.0});
    v.field("rotation_rad", rotation_rad, "deviation of the rotation about each axis while stationary, at most, rad",
            {0.0, 1.0});
    v.field("magnitude_tolerance", magnitude_tolerance,
            "deviation from 9.80665 m/s^2 from which a measured gravity is invalid, share", {0.0, 1.0});
  }
};

struct GravityEstimate {
  bool measured = false;     // at least one static window, and a plausible magnitude
  bool implausible = false;  // measured, but not believed
  std::int64_t windows = 0;  // static ones
  Eigen::Vector3d gravity_world_mps2 = Eigen::Vector3d::Zero();
  // Standard deviation of the windows' estimates; nan below two.
  Eigen::Vector3d scatter_mps2 = Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
};

// Gravity in the world frame from the stationary probe: the accelerometer then reads f = −g in the marker frame
// (erratum 5), so gravity_world = −R_world_marker f (erratum 4). Judged in windows of `window_s`: at rest are those in
// which specific force, position and rotation deviate less than the config's limits. The estimate is the mean over the
// windows, each with its mean f and mean rotation. A calibration error of the accelerometer is in it.
class GravityEstimator {
 public:
  // `calibration.rotation_known` must be true for an estimate; false leaves it unmeasured.
  GravityEstimator(const RestConfig& config, const Calibration& calibration);

  void add_probe(std::int64_t t_ns, const Eigen::Vector3d& accel_counts);
  // A pose as received: the tracker's latency is taken off.
  void add_pose(std::int64_t t_ns, const Pose& T_world_marker);

  GravityEstimate estimate() const;
  // Judges what is still open; nothing is to follow.
  void finish();

 private:
  // Mean and deviation, by Welford's recursion.
  struct Moments {
    std::int64_t count = 0;
    Eigen::Vector3d mean = Eigen::Vector3d::Zero();
    Eigen::Vector3d square = Eigen::Vector3d::Zero();
    void add(const Eigen::Vector3d& value);
    Eigen::Vector3d deviation() const;
  };
  struct Window {
    std::int64_t index = 0;
    Moments specific_force;
    Moments position;
    Moments turn;  // from the first rotation
    Eigen::Quaterniond first_rotation = Eigen::Quaterniond::Identity();
  };
  Window* window_at(std::int64_t t_ns);
  void judge(const Window& window);

  RestConfig config_;
  AccelerometerCalibration accelerometer_;
  Eigen::Vector3d position_limit_m_;
  std::int64_t window_ns_;
  std::int64_t latency_ns_;
  std::int64_t closed_before_ = std::numeric_limits<std::int64_t>::min();  // windows below were judged
  std::deque<Window> open_;                                                // by index, few
  Moments gravity_;
};

}  // namespace asperity
