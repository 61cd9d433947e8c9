#pragma once

#include <cstdint>
#include <span>

#include <Eigen/Core>

#include "asperity/recording/recording.h"
#include "asperity/trajectory/estimate_trajectory_thesis.h"
#include "asperity/trajectory/trajectory_result.h"

namespace asperity {

// The log-likelihood of measured positions under the thesis's state [p ṗ] driven by white acceleration of the density
// `accel_psd` ((m/s²)²/Hz), Q(Δt) = accel_psd [Δt³/3, Δt²/2; Δt²/2, Δt] an axis: Σ −½ (d² + log |S|) over the
// innovations, d² over the three axes at most 16.8 (99.92 % of good ones are below) so that a wild pose cannot decide.
// The constant is left out. Times rise; the first position is the start.
double white_acceleration_likelihood(std::span<const std::int64_t> t_ns, std::span<const Eigen::Vector3d> measured_m,
                                     const Eigen::Vector3d& R_m2, double accel_psd);

// The density of white acceleration under which that is greatest: on a grid of a factor 10 from 1e-8 to 1e6, then by
// golden section to 2 %.
double likeliest_white_acceleration(std::span<const std::int64_t> t_ns, std::span<const Eigen::Vector3d> measured_m,
                                    const Eigen::Vector3d& R_m2);

// The thesis's trajectory (estimate_trajectory_thesis.h) with its position filter tuned as well as it can be without
// knowing the truth: the same state, but driven by white acceleration (erratum 8) of the density under which the
// innovations are likeliest, and corrected by each pose once, at the pose's own time. (The seed interpolates the poses
// to 5 ms first; such positions repeat one another's errors, so their innovations have no likelihood and the filter's
// covariance is too small.) Forward only but for the next pose, which the thesis's interpolation uses as well: between
// two poses the state follows from the first, corrected by what the second changes (a step of Rauch, Tung and
// Striebel's smoother). Orientations, accelerations and times are the thesis's.
//
// cov_world_tip_m2 is the filter's own, diagonal, and those of latency and calibrated tip: right as far as
// the hand's acceleration is white and poses are not wild. `config.white_acceleration_mps2`, `position_fraction` and
// `velocity_time_s` have no effect. metrics: the thesis's, and white_acceleration_psd, (m/s²)²/Hz. Throws Error as the
// thesis does.
TrajectoryResult estimate_trajectory_tuned(const Recording& recording, const ThesisTrajectoryConfig& config);

}  // namespace asperity
