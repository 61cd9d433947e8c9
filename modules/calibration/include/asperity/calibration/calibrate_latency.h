#pragma once

#include <array>
#include <string_view>

#include "asperity/calibration/latency_fit.h"
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
            "solve for the sensor's rotation in the marker even if it is said to be known");
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

// The tracker's latency from a recording in which the probe is shaken, by maximum likelihood: the orientation
// that the gyroscope integrates to (or the position that the accelerometer integrates to, with gravity and lever arm)
// is compared with the poses at a continuous shift, while the integral drifts as a random walk; sensor bias and, where
// the calibration does not know it, the sensor's rotation in the marker frame are solved for
// (docs/calibration-optics.md). Throws Error, saying what to record instead, for too few poses, motion that is too weak
// or too regular, or sensors that do not show the same motion.
LatencyFit calibrate_latency(const Recording& recording, const LatencyConfig& config = {});

}  // namespace asperity
