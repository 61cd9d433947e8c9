#pragma once

#include <string_view>

#include "asperity/recording/recording.h"
#include "asperity/trajectory/estimate_trajectory_fused.h"
#include "inertial_smoother.h"

// How calibration and settings become the smoother's problem, for the whole recording as for a window of it.
namespace asperity::inertial_smoother {

// Of the tracker against the probe, and its standard deviation: only the difference of the two streams' latencies
// shows in the data.
double prior_latency_s(const Calibration& calibration);
double latency_sigma_s(const Calibration& calibration);

// How far the accelerometer may be from where the calibration has it. One that says nothing of its place leaves it
// within kPlaceUnknown_m of the tip at least; a stated place without a standard deviation is taken as it is.
inline constexpr double kPlaceUnknown_m = 0.05;
double lever_sigma_m(const Calibration& calibration);

// Which quantities are estimated besides the motion and the biases. A window of a few seconds (`whole` false) says too
// little of the sensors' matrices, gravity and the tracker's slow error.
Layout choose_layout(const Calibration& calibration, bool has_gyro, bool whole, const FusedConfig& config);

// The covariance of the first state.
Square prior(const Calibration& calibration, bool has_gyro, const FusedConfig& config, const Layout& layout);

// What the first pose shows is the marker's place: an accelerometer elsewhere in the marker is elsewhere in the world
// too. To be called with the problem's start and its covariance in place.
void tie_place_to_lever(Problem& problem);

// The tracker's σ as stated. One of zero says that nobody measured it: the seed's tracker stands in (Fig. 9).
inline constexpr double kPositionFloor_m = 1e-5;  // below this a tracker's σ is not believed
inline constexpr double kRotationFloor_rad = 1e-4;
Eigen::Vector3d stated_sigma_m(const TrackerCalibration& tracker);
Eigen::Vector3d stated_sigma_rad(const TrackerCalibration& tracker);

// The white noise of each pose as stated: by its own σ, else by the calibration's law of distance and tilt where the
// world is the camera's frame, else the calibration's σ of all poses. `body` is whose markers the law is about, the
// probe's without a name.
std::vector<PoseNoise> stated_pose_noise(const TrackerStream& stream, const Calibration& calibration,
                                         const RecordingInfo& info, std::string_view body = {});

// The slow error and the tip's σ as stated or, where nothing is said of them, as the settings have them. A tip at the
// marker's origin is the tracked point itself.
Eigen::Matrix<double, 6, 1> slow_sigma(const Calibration& calibration, const FusedConfig& config);
Eigen::Vector3d tip_sigma_m(const Calibration& calibration, const FusedConfig& config);

// The settings that become numbers of the problem: time jitter, gate, random walks, slow error, the tip's σ.
void set_constants(const Calibration& calibration, bool has_gyro, const FusedConfig& config, Problem& problem);

}  // namespace asperity::inertial_smoother
