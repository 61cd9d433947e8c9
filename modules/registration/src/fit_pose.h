#pragma once

#include <optional>
#include <vector>

#include "iteration_watch.h"
#include "match_points.h"

namespace asperity::registration {

// A motion held at a value: row · motion_between(reference, pose) = target.
struct Hold {
  Vector6 row = Vector6::Zero();
  double target = 0.0;
};

struct FitOptions {
  double robust_sigmas = 3.5;
  double isotropic = 1.0;
  double isotropic_decay = 0.6;
  int max_iterations = 60;
  double step_sigmas = 0.1;      // ends when the step and what is to go are smaller, in standard deviations of the pose
  double guess_sigma_m = 0.0;    // 0: no prior on the motion from `reference`, RMS over the points
  double guess_sigma_rad = 0.0;  // 0: none on its turn
  double alike = 1.0;            // how many points share one error: the prior counts for as much more against them
  CentredPose reference;         // the guess
  std::vector<Hold> holds;       // at a motion from `reference`
  double fixed_scale_m = 0.0;    // of the distances; 0: measured
  double known_scale_m = 0.0;    // where the pose has been fitted to some of the points already; 0: it has not
  const IterationWatch* watch = nullptr;
};

struct Fit {
  CentredPose pose;
  double scale_m = 0.0;  // of the distances, where it stopped
  double cost_m2 = 0.0;  // mean robust cost of a point at that scale; a point without a pair costs as an outlier
  int iterations = 0;
  StopRule stopped_by = StopRule::kIterationLimit;
  bool matched = false;  // the matcher's pairs are those of `pose`, to first order in the last step
  bool enough = true;    // at least three usable pairs at each step
};

// Gauss–Newton on SE(3) from `start`, closest points anew each step (docs/registration.md). Throws Cancelled where the
// watch does.
Fit fit_pose(Matcher& matcher, const PointSet& points, const CentredPose& start, const FitOptions& options);

// The mean robust cost (Welsch) of the matcher's present pairs at a scale.
double robust_cost_m2(const Matcher& matcher, double width_m);

// Sum over usable pairs within `limit_m` of J'J.
Matrix6 information(const Matcher& matcher, const CentredPose& pose, double limit_m);

}  // namespace asperity::registration
