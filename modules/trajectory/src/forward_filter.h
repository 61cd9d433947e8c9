#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "asperity/geometry/motion.h"
#include "causal_feed.h"
#include "inertial_smoother.h"

// The filter of the smoother by itself, an interval between two epochs at a time.
namespace asperity::inertial_smoother {

class StepFilter {
 public:
  // The window's settings; its knots and epochs are taken interval by interval.
  explicit StepFilter(const Problem& window);

  // Carried from epoch e − 1 to e, before the pose that e may bring.
  Checkpoint predict(std::size_t e, const Checkpoint& from);
  // Updated with the pose of epoch e; with its log-likelihood (inertial_smoother.h: without its constant).
  Filtered update(std::size_t e, const Checkpoint& before);

  Problem settings;  // noise scales and gate may be set

 private:
  const Problem& window_;
};

// The covariance of the tip's position, world frame, m²; the error of the tip's place in the marker is in it.
Eigen::Matrix3d tip_covariance(const Checkpoint& at, const Problem& problem, const Eigen::Vector3d& tip_in_marker_m);

// The accelerometer's motion at one sample, and the way from it to the tip, world frame.
struct PointState {
  Eigen::Vector3d p_m, v_mps, a_mps2, omega_radps, arm_m;
  Eigen::Quaterniond q_world_marker;
};

// The samples of the interval that ends with epoch e, after its first knot, dead reckoned from `x` at its beginning;
// without the pose at its end.
std::vector<PointState> dead_reckon(const Problem& window, std::size_t e, const Nominal& x,
                                    const Eigen::Vector3d& tip_in_marker_m);

// Gathers a causal method's samples.
class CausalMotion {
 public:
  explicit CausalMotion(const Calibration& calibration) : calibration_(calibration) {}

  // The samples of the interval that ends with epoch e; covariances are those at its two ends, linear between, and
  // `spread_m2`, one a sample or empty, is added. `latency_s` is what the filter has added to the prior.
  void append(const CausalFeed& feed, std::size_t e, const std::vector<PointState>& states,
              const Eigen::Matrix3d& begin_m2, const Eigen::Matrix3d& end_m2,
              const std::vector<Eigen::Matrix3d>& spread_m2, double latency_s);

  TipMotion motion;

 private:
  const Calibration& calibration_;
  std::size_t next_row_ = 0;
  // For the angular acceleration: rates of the last 4 ms.
  std::vector<std::pair<double, Eigen::Vector3d>> rates_;
};

}  // namespace asperity::inertial_smoother
