#pragma once

#include "asperity/base/progress.h"
#include "asperity/recording/recording.h"
#include "asperity/trajectory/calibrate_inertial.h"
#include "asperity/trajectory/trajectory_result.h"

namespace asperity {

struct FusedConfig {
  InertialConfig inertial;
  double accel_bias_sigma_mps2 = 0.3;           // prior
  double accel_bias_walk_mps2_per_rts = 0.003;  // random walk, (m/s²)/√s
  double gyro_bias_sigma_radps = 0.05;          // prior
  double gyro_bias_walk_radps_per_rts = 1e-4;   // random walk, (rad/s)/√s
  double angular_accel_radps2_per_rtHz = 0.3;   // without a gyroscope: white angular acceleration, (rad/s²)/√Hz
  double accel_matrix_sigma = 0.01;      // scale and alignment of the accelerometer where no standard errors are stated
  double gyro_matrix_sigma = 0.01;       // of the gyroscope
  double gravity_sigma_mps2 = 0.02;      // of the stated gravity, each axis
  double tip_sigma_m = 1e-4;             // of the tip in the marker, each axis, where the calibration states none
  double slow_share = 0.2;               // the tracker's drift, a share of its white noise
  double slow_time_s = 1.0;              // its time constant
  double process_noise_scale = 0.0;      // factor on the process noise, nothing learnt of it; 0: learnt by likelihood
  double tracker_time_sigma_s = 0.3e-3;  // jitter of one pose's time
  double gate_chi2 = 16.8;               // a pose farther off (3 degrees of freedom) loses weight as 1/d⁴
  int passes = 4;                        // filter–smoother passes; noise, weights and constants are refined between
  bool adapt_tracker_noise = true;       // scale the calibrated σ by what the residuals show
  bool estimate_latency = true;          // within its prior

  template <class V>
  void visit(V& v) {
    v.group("inertial", inertial);
    v.field("accel_bias_sigma_mps2", accel_bias_sigma_mps2, "prior of the accelerometer's bias, m/s2", {0, 100});
    v.field("accel_bias_walk_mps2_per_rts", accel_bias_walk_mps2_per_rts, "random walk of that bias, (m/s2)/sqrt(s)",
            {0, 10});
    v.former("accel_bias_walk_mps2_rts");
    v.field("gyro_bias_sigma_radps", gyro_bias_sigma_radps, "prior of the gyroscope's bias, rad/s", {0, 10});
    v.field("gyro_bias_walk_radps_per_rts", gyro_bias_walk_radps_per_rts, "random walk of that bias, (rad/s)/sqrt(s)",
            {0, 10});
    v.former("gyro_bias_walk_radps_rts");
    v.field("angular_accel_radps2_per_rtHz", angular_accel_radps2_per_rtHz,
            "without a gyroscope: white angular acceleration, (rad/s2)/sqrt(Hz)", {1e-6, 1e4});
    v.former("angular_accel_radps2_rtHz");
    v.field("accel_matrix_sigma", accel_matrix_sigma,
            "scale and alignment of the accelerometer where its calibration states no error; 0: not estimated", {0, 1});
    v.field("gyro_matrix_sigma", gyro_matrix_sigma, "of the gyroscope; 0: not estimated", {0, 1});
    v.field("gravity_sigma_mps2", gravity_sigma_mps2, "of the stated gravity, each axis, m/s2; 0: not estimated",
            {0, 10});
    v.field("tip_sigma_m", tip_sigma_m, "of the tip in the marker, each axis, where its calibration states none, m",
            {0, 1});
    v.field("slow_share", slow_share, "the tracker's drift as a share of its white noise; 0: none", {0, 100});
    v.field("slow_time_s", slow_time_s, "its time constant, s", {0.01, 1000});
    v.field("process_noise_scale", process_noise_scale, "factor on the process noise; 0: learnt from the recording",
            {0, 1e6});
    v.field("tracker_time_sigma_s", tracker_time_sigma_s, "jitter of one pose's time, s", {0, 1});
    v.field("gate_chi2", gate_chi2, "a pose farther off (squared, 3 degrees of freedom) loses weight", {3, 1e6});
    v.field("passes", passes, "filter-smoother passes", {1, 10});
    v.field("adapt_tracker_noise", adapt_tracker_noise, "scale the tracker's sigma by what the residuals show");
    v.field("estimate_latency", estimate_latency, "estimate the tracker's latency within its prior");
  }
};

// The tip's motion at the probe's own sample times, from both streams at once: an error-state Kalman
// filter in which the probe's samples drive the state and the tracker's poses correct it when they came,
// and a fixed-interval smoother over the whole recording (docs/trajectory.md has the mathematics). The
// state is the accelerometer's position and velocity, the marker's orientation, the biases (without a
// gyroscope: the angular rate) and the tracker's latency; the lever arms marker–accelerometer–tip are in
// the model. Throws Error if the streams do not overlap by at least four poses.
TrajectoryResult estimate_trajectory_fused(const Recording& recording, const FusedConfig& config,
                                           const Observer& observer = {});

}  // namespace asperity
