#pragma once

#include "asperity/recording/calibration.h"
#include "asperity/trajectory/estimate_trajectory_fused.h"
#include "inertial_smoother.h"

// How calibration and settings become the smoother's problem, for the whole recording as for a window of it.
namespace asperity::inertial_smoother {

// Of the tracker against the probe, and its standard deviation: only the difference of the two streams' latencies
// shows in the data.
double prior_latency_s(const Calibration& calibration);
double latency_sigma_s(const Calibration& calibration);

// Which constants the calibration leaves to be estimated.
Layout choose_layout(const Calibration& calibration, const FusedConfig& config);

// The covariance of the first state.
Square prior(const Calibration& calibration, bool has_gyro, const FusedConfig& config, const Layout& layout);

// The tracker's σ as stated. One of zero says that nobody measured it: the seed's tracker stands in (Fig. 9).
inline constexpr double kPositionFloor_m = 1e-5;  // below this a tracker's σ is not believed
inline constexpr double kRotationFloor_rad = 1e-4;
Eigen::Vector3d stated_sigma_m(const TrackerCalibration& tracker);
Eigen::Vector3d stated_sigma_rad(const TrackerCalibration& tracker);

// The settings that become numbers of the problem: time jitter, gate, random walks.
void set_constants(const FusedConfig& config, bool has_gyro, Problem& problem);

// Finds the factors on the process noise under which the poses of the problem's first 12 s are likeliest.
void choose_process_noise(Problem& problem, bool has_gyro);

}  // namespace asperity::inertial_smoother
