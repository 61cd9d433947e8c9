#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "asperity/recording/calibration.h"
#include "long_run_covariance.h"

namespace asperity {

struct PivotPoses {
  std::vector<Eigen::Matrix3d> R;  // R_world_marker
  std::vector<Eigen::Vector3d> p_m;

  std::size_t size() const { return R.size(); }
};

struct Pivot {
  Eigen::Vector3d tip_m = Eigen::Vector3d::Zero();     // in the marker frame
  Eigen::Vector3d dimple_m = Eigen::Vector3d::Zero();  // in the world

  Eigen::Vector3d miss_m(const PivotPoses& poses, std::size_t i) const {
    return poses.R[i] * tip_m + poses.p_m[i] - dimple_m;
  }
};

// Plain least squares over the poses at `places`; the direction that they leave open is set to zero.
Pivot solve_pivot(const PivotPoses& poses, const std::vector<std::size_t>& places);

// Distance from the dimple in units of the tracker's stated noise.
double pivot_distance(const Pivot& pivot, const PivotPoses& poses, std::size_t i, const TrackerCalibration& tracker);

struct PivotFit {
  Pivot pivot;
  Eigen::Matrix<double, 6, 6> covariance;              // of tip and dimple, for errors that are correlated in time
  Eigen::Matrix<double, 6, 6> independent_covariance;  // for errors that are not
  double noise_ratio = 0.0;
  double rms_m = 0.0;
  double expected_rms_m = 0.0;
};

// The weighted fit over the poses of `runs`, begun at `start`, with the rotation noise taken out of the design.
PivotFit fit_pivot(const PivotPoses& poses, const std::vector<RowRun>& runs, const Pivot& start,
                   const TrackerCalibration& tracker);

}  // namespace asperity
