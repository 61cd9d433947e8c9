#pragma once

#include <array>
#include <limits>
#include <string_view>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "asperity/base/problem.h"
#include "asperity/calibration/calibration_verdict.h"
#include "asperity/recording/recording.h"

namespace asperity {

enum class LatencyMethod { kAuto, kGyroscope, kAccelerometer };
inline constexpr std::array<std::string_view, 3> kLatencyMethodNames{"auto", "gyroscope", "accelerometer"};

struct LatencyConfig {
  LatencyMethod method = LatencyMethod::kAuto;
  bool solve_rotation = false;
  double least_latency_s = -0.1;
  double largest_latency_s = 0.4;
  double scan_step_s = 0.004;
  double largest_gap_s = 0.05;
  int least_poses = 100;
  double largest_error_s = 0.002;
  double good_error_s = 0.0005;
  double largest_unexplained = 0.5;
  double least_runner_up_ratio = 1.2;
  double outlier_sigmas = 6.0;

  template <class V>
  void visit(V& v) {
    v.choice("method", method, kLatencyMethodNames, "auto: by the gyroscope if the probe has one");
    v.field("solve_rotation", solve_rotation,
            "solve for the sensor's rotation in the marker even if it is stated to be known");
    v.field("least_latency_s", least_latency_s, "the latency is sought from here, s", {-10.0, 10.0});
    v.field("largest_latency_s", largest_latency_s, "to here, s", {-10.0, 10.0});
    v.field("scan_step_s", scan_step_s, "step of the coarse search, s", {1e-5, 0.1});
    v.field("largest_gap_s", largest_gap_s, "the probe's samples are not integrated over longer gaps, s", {1e-4, 10.0});
    v.field("least_poses", least_poses, "poses that are needed", {20, 1000000});
    v.field("largest_error_s", largest_error_s, "standard error above which the motion is refused as too weak, s",
            {0.0, 1.0});
    v.field("good_error_s", good_error_s, "standard error above which the verdict warns, s", {0.0, 1.0});
    v.field("largest_unexplained", largest_unexplained,
            "share of the motion's variance that may differ between sensor and tracker", {0.0, 1.0});
    v.field("least_runner_up_ratio", least_runner_up_ratio,
            "the next best latency must fit worse by this factor, or the motion is refused as too regular", {1.0, 1e6});
    v.field("outlier_sigmas", outlier_sigmas, "poses further off the prediction are left out", {4.0, 1e6});
  }
};

// How much later than the probe's samples the tracker's poses are stamped, and what else came out with it.
struct LatencyFit {
  double latency_s = 0.0;  // a pose's true time on the probe's samples' clock is its t_ns minus this
  double latency_error_s = std::numeric_limits<double>::quiet_NaN();  // standard error
  double clock_rate = 0.0;  // how the latency grows, s/s; the latency is that of the recording's middle
  double clock_rate_error = 0.0;
  bool by_gyroscope = true;  // else by the accelerometer

  // What the sensor needed to agree with the tracker, in the marker frame: x_marker = scale · R (x_sensor) − bias.
  bool rotation_solved = false;
  Eigen::Quaterniond R_marker_sensor = Eigen::Quaterniond::Identity();
  Eigen::Vector3d rotation_error_rad = Eigen::Vector3d::Zero();
  bool scale_solved = false;
  double scale = 1.0;
  double scale_error = 0.0;
  Eigen::Vector3d bias = Eigen::Vector3d::Zero();  // rad/s or m/s²
  Eigen::Vector3d bias_error = Eigen::Vector3d::Zero();

  Eigen::Vector3d residual = Eigen::Vector3d::Zero();  // noise of a pose along the world's axes, rad or m
  Eigen::Vector3d drift = Eigen::Vector3d::Zero();     // rad/√s, or m/s/√s: what the integrated sensor drifts by
  double motion = 0.0;                                 // RMS, rad/s or m/s
  std::size_t poses = 0;
  double runner_up_s = std::numeric_limits<double>::quiet_NaN();     // the next best latency; nan: there is none
  double runner_up_ratio = std::numeric_limits<double>::infinity();  // its sum of squares over the best one's
  std::vector<double> scan_latency_s, scan_cost;  // the coarse search: share of the motion that is not explained
  Problems problems;
  CalibrationVerdict verdict;
};

// The tracker's latency from a recording in which the probe is shaken, by maximum likelihood: the orientation
// that the gyroscope integrates to (or the position that the accelerometer integrates to, with gravity and lever arm)
// is compared with the poses at a continuous shift, while the integral drifts as a random walk; sensor bias and, where
// the calibration does not know it, the sensor's rotation in the marker frame are solved for
// (docs/calibration-optics.md). Throws Error, saying what to record instead, for too few poses, motion that is too weak
// or too regular, or sensors that do not show the same motion.
LatencyFit calibrate_latency(const Recording& recording, const LatencyConfig& config = {});

}  // namespace asperity
