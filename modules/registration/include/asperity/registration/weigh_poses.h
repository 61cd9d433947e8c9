#pragma once

#include <optional>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "asperity/registration/registration_config.h"
#include "asperity/registration/registration_iteration.h"
#include "asperity/registration/registration_result.h"
#include "asperity/registration/registration_surface.h"

namespace asperity {

struct WeighConfig {
  double memory_m = 2e-3;          // least length over which heights are averaged
  double slow_length_m = 20e-3;    // over which the drift of a path lasts; 0: each point has its own
  double slow_ratio_spread = 0.5;  // standard deviation of the logarithm of its size over the stated one
  double relief_mean_ratio = 2.0;  // of the relief's mean to the noise of the averages, plus the relief itself
  double guess_sigma_m = 10e-3;
  double guess_sigma_rad = 0.175;
  double guess_lapse = 0.02;  // the probability that a guess is nothing of the kind
};

// A pose with what the paths say for it.
struct WeighedPose {
  Pose T_mesh_world;
  double log_mass = 0.0;          // logarithm of its posterior probability, to a constant common to all
  double fit = 0.0;               // −2 log likelihood, to the same
  double slow_ratio = 1.0;        // of the slow error that it needs over the stated one, standard deviations
  double slow_ratio_sigma = 0.0;  // standard error of its logarithm, by the paths alone
  double log_volume = 0.0;        // of the volume of poses that are as likely, rad³ m³ (Laplace)
  double noise_m = 0.0;           // of the averages, the largest of the paths'
  double outlying = 0.0;          // share of the path that is not such an error
  Eigen::Matrix<double, 6, 6> information = Eigen::Matrix<double, 6, 6>::Zero();  // of (rotation rad, shift m) about
                                                                                  // the points' mean, mesh frame
};

// The posterior probabilities of poses. Heights over the mesh, averaged over blocks of path, are the slow error of
// the path along the normal (Gauss–Markov along the path with the stated covariance, times the square of a ratio that
// is not known exactly), the mean of the relief, and white noise: correlated points count as the few that they are. A
// block is memory_m long, or as long as a period of the path's relief, which the path shows by itself
// (relief_scale.h): with shorter blocks a relief of holes would be a noise of the means, larger than what the mesh
// shows, and smaller at a wrong pose where the path leans against the normal. Each path has its own noise, and its
// relief's mean is known to twice that and the RMS of a periodic relief. The likelihood comes from a Kalman filter
// along the path (Schweppe 1965). The ratio, which has a log-normal prior about one, and the noise are those of largest
// restricted likelihood at each pose (Patterson and Thompson 1971): the pose has taken six degrees of freedom out of
// the heights, and a short path would else seem to have nearly no slow error. A pose that lies badly needs a large
// ratio and pays for it with the logarithm of it for each stretch of slow_length_m, and with the prior. Beyond four
// standard deviations a block costs no more. Each candidate is descended (Gauss–Newton) to its own maximum; those that
// end at the same place are one. Its mass is the likelihood times the prior times the volume (Laplace's approximation).
// The prior is that of the guess, a normal distribution but for guess_lapse; without a guess all poses are alike. Comes
// back by mass, the best first. Throws Error as register_path does, and Cancelled.
std::vector<WeighedPose> weigh_poses(std::span<const MeasuredPath> paths, const RegistrationSurface& surface,
                                     std::span<const Pose> candidates, const std::optional<Pose>& guess,
                                     const WeighConfig& config, const RegistrationConfig& registration,
                                     const RegistrationObserver& observer = {});

// The same at a pose as it is.
WeighedPose weigh_pose(std::span<const MeasuredPath> paths, const RegistrationSurface& surface, const Pose& pose,
                       const std::optional<Pose>& guess, const WeighConfig& config,
                       const RegistrationConfig& registration);

}  // namespace asperity
