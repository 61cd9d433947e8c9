#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "asperity/base/config.h"
#include "asperity/calibration/calibration_verdict.h"
#include "asperity/recording/recording.h"

namespace asperity {

struct CalibrateTipConfig {
  double least_turn_rad = 0.02;
  double least_spread = 0.08;
  double slip_sigmas = 4.5;
  double shortest_s = 0.3;
  double settle_s = 0.1;
  double least_share = 0.4;
  double residual_ratio = 3.0;
  double uncertainty_m = 0.0003;
  int trials = 500;
  std::int64_t seed = 1;

  template <class V>
  void visit(V& v) {
    v.field("least_turn_rad", least_turn_rad,
            "rotation of the probe from one pose to the next in the search for the dimple, rad", {0.0, 1.0});
    v.field("least_spread", least_spread, "a swing whose directions spread less in the worst direction is refused, rad",
            {0.0, 1.0});
    v.field("slip_sigmas", slip_sigmas, "a pose further from the dimple is left out, standard deviations",
            {3.0, 100.0});
    v.field("shortest_s", shortest_s, "stretches in the dimple shorter than this are left out, s", {0.0, 60.0});
    v.field("settle_s", settle_s, "left out before and after a stretch out of the dimple, s", {0.0, 60.0});
    v.field("least_share", least_share, "share of the poses in the dimple, else limited", {0.0, 1.0});
    v.field("residual_ratio", residual_ratio, "residual over the tracker's stated noise of a valid one", {0.1, 1000.0});
    v.field("uncertainty_m", uncertainty_m, "largest standard error of the tip, else limited, m", {0.0, 1.0});
    v.field("trials", trials, "random sets of poses that the search begins from", {10, 100000});
    v.field("seed", seed, "of the search", {0.0, 9e15});
  }
};

// Stretches of time, of the tracker's stamps.
struct TimeStretch {
  std::int64_t start_ns = 0;
  std::int64_t end_ns = 0;
};

struct TipCalibration {
  Eigen::Vector3d tip_in_marker_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d stderr_m = Eigen::Vector3d::Zero();
  Eigen::Matrix3d covariance_m2 = Eigen::Matrix3d::Zero();
  Eigen::Vector3d dimple_world_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d dimple_stderr_m = Eigen::Vector3d::Zero();
  double rms_m = 0.0;              // distance of the poses' tips from the dimple
  double expected_rms_m = 0.0;     // what the tracker's stated noise would give
  double noise_ratio = 0.0;        // the residuals' deviation over the stated noise
  double independent_poses = 0.0;  // poses whose errors would be as good if they were independent
  double spread = 0.0;             // of the rotations in the direction that they determine worst, rad for small swings
  Eigen::Vector3d worst_direction = Eigen::Vector3d::UnitZ();  // that direction, in the marker frame
  std::size_t poses = 0;
  std::size_t used = 0;
  std::vector<TimeStretch> used_stretches;
  CalibrationVerdict verdict;
};

// The tip's position on the probe by pivoting: the tip is in a dimple while the probe is swung, so that
// R_i t + p_i = c for every pose T_world_marker = (R_i, p_i); t is the tip in the marker frame, c the dimple in the
// world. The tip here is what stays in place: the centre of its ball, if it has one; the ball's radius does not enter.
//
// Search: of poses thinned to equal rotations (a static interval must not outvote the swing) random fours are solved,
// and the set of least 40 % quantile of distance wins. Fit: weighted least squares with the tracker's noise in position
// and rotation, Σ_i = Σ_p + [R_i t]× Σ_φ [R_i t]×ᵀ; the noise of R_i, which also enters the design and would pull t
// towards the marker, is taken out of the normal equations (Fuller, Measurement Error Models, 1987). Poses further than
// slip_sigmas of the residuals' own size are left out, and so are their neighbours in time. Standard errors: the
// tracker's errors are alike from frame to frame, so the sum of the poses' influences is given its long-run variance
// (in the manner of Newey and West, 1987; window by Sokal's rule, 1997) instead of that of independent frames; the size
// of the noise comes from the residuals, `tracker` only gives the weights. An error of the tracker that repeats with
// the direction is not seen.
//
// Throws Error, saying what to do, for fewer than 60 poses, for a probe that hardly rotated and for a swing that leaves
// a direction of t undetermined (about one axis only: along that axis).
TipCalibration calibrate_tip(const TrackerStream& poses, const TrackerCalibration& tracker,
                             const CalibrateTipConfig& config = {});

}  // namespace asperity
