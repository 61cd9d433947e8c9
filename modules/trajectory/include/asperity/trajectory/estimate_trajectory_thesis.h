#pragma once

#include "asperity/base/config.h"
#include "asperity/recording/recording.h"
#include "asperity/trajectory/reject_outliers.h"
#include "asperity/trajectory/trajectory_result.h"

namespace asperity {

struct ThesisTrajectoryConfig {
  OutlierConfig outliers;
  double period_s = 0.005;
  bool average_over_period = true;
  double scan_speed_mps = 0.0;
  double velocity_time_s = 10.0;
  double position_fraction = 0.1;
  double rotation_rate_radps = 0.2;
  double white_acceleration_mps2 = 0.0;

  template <class V>
  void visit(V& v) {
    v.group("outliers", outliers);
    v.field("period_s", period_s, "both streams are resampled this often, s", {1e-5, 1.0});
    v.field("average_over_period", average_over_period, "probe samples are averaged over a period, not picked");
    v.field("scan_speed_mps", scan_speed_mps, "average scanning velocity for Q, m/s; 0: measured in the recording",
            {0.0, 10.0});
    v.field("velocity_time_s", velocity_time_s, "time in which the velocity may change by the scanning velocity, s",
            {1e-3, 1e3});
    v.field("position_fraction", position_fraction,
            "position noise of a step, as a part of the distance travelled in it", {0.0, 10.0});
    v.field("white_acceleration_mps2", white_acceleration_mps2,
            "above 0: Q of a white acceleration, constant over a step, instead of the thesis's diagonal, m/s²",
            {0.0, 1e4});
    v.field("rotation_rate_radps", rotation_rate_radps, "rotation that a step may gain, rad/s", {0.0, 100.0});
  }
};

// The tip's motion by the thesis's method, a sample every period (thesis §4.1 to §4.3, B.1): outliers
// rejected, streams synchronised, positions and orientations Kalman filtered forward, gravity removed.
// B.1's position data is the tip's, so the tip offset is applied to the tracker's poses before the
// filter. The accelerometer is taken to be at the tip, wherever it really sits.
//
// With white_acceleration_mps2 = σ the filter is the tuned one of comparisons (erratum 8): Q = σ² [Δt⁴/4,
// Δt³/2; Δt³/2, Δt²] an axis. Otherwise
// Q = diag((position_fraction·v·Δt)², v²·Δt/velocity_time_s) an axis with v the scanning velocity:
// within velocity_time_s the velocity wanders by v (docs/thesis-method.md compares values of it). R = the
// tracker's position variance plus what its rotation variance makes of the lever arm, averaged over the
// recording.
//
// metrics: duration_s, scan_speed_mps, rejected_samples, longest_tracker_gap_s. The motion has no
// covariance: the filter's own counts interpolated poses as independent. Throws Error for streams that
// cannot be synchronised (synchronise_streams.h) or a calibration that cannot be inverted.
TrajectoryResult estimate_trajectory_thesis(const Recording& recording, const ThesisTrajectoryConfig& config);

}  // namespace asperity
