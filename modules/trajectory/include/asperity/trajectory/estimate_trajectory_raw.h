#pragma once

#include "asperity/base/config.h"
#include "asperity/recording/recording.h"
#include "asperity/trajectory/reject_outliers.h"
#include "asperity/trajectory/trajectory_result.h"

namespace asperity {

struct RawTrajectoryConfig {
  OutlierConfig outliers;

  template <class V>
  void visit(V& v) {
    v.group("outliers", outliers);
  }
};

// The tracker's poses and nothing else: what every method has to beat. The tip of each pose, T_world_marker tip, at the
// pose's time less the latency; straight lines between, at the probe's samples; orientations by SLERP. The
// accelerations beside them are the sensor's there with gravity removed, which only k_c needs.
//
// Stated error. At the part u of the gap h between two poses with independent errors of covariance C_k
// (σ of position and of rotation on the lever arm, tracker.csv's calibration),
//
//   Cov = (1−u)² C_k + u² C_{k+1} + diag(α²) (u (1−u) h²/2)² + v vᵀ σ_t² + R Σ_tip Rᵀ
//
// where the third term is what a straight line leaves out of a motion of acceleration α, the fourth the latency's
// standard deviation σ_t at the velocity v over ±0.1 s, the fifth the calibrated tip's error. α² an axis comes from the
// tip's second differences D over three poses: E D² = 6 diag C + α² h⁴, the median of D² taken for the mean so that no
// wild pose decides (0.4549 of it for a normal deviate). Poses that are wrong are not recognised: their error is not in
// it.
//
// metrics: poses, interpolated_acceleration_mps2 (|α|). Throws Error for fewer than four poses, poses out of order, or
// none in the probe's time.
TrajectoryResult estimate_trajectory_raw(const Recording& recording, const RawTrajectoryConfig& config);

}  // namespace asperity
