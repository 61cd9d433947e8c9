#pragma once

#include <vector>

#include "fit_pose.h"
#include "path_chain.h"

namespace asperity::registration {

// What a fit determines, about the points' mean.
struct Observability {
  Matrix6 covariance = Matrix6::Zero();
  Matrix6 metric = Matrix6::Zero();
  std::vector<Vector6>
      unobservable;  // undetermined motions, orthonormal in the metric: translations first, then rotations
  double unobservable_sigma_m = 0.0;  // the largest standard deviation among them
  std::vector<Vector6> held;          // those of them along which the guess is to be kept
  double determined_rms_m = 0.0;      // of the points' motion over all determined ones
};

// `matcher` holds all points at `pose`, where they fit with a standard deviation sigma_m. Directions by the
// information matrix in the metric of the points' motion; weak ones are tried by sliding (docs/registration.md).
Observability find_unobservable_dofs(const RegistrationSurface& surface, const PointSet& points,
                                     const MatchRules& rules, const Matcher& matcher, const CentredPose& pose,
                                     double sigma_m, const RegistrationConfig& config);

// The facets' sag below the smooth surface they stand for, RMS over the usable pairs.
double facet_sag_m(const RegistrationSurface& surface, const Matcher& matcher);

// Appends the rotations whose standard deviation is above the limit to `result.undetermined`, unless one about nearly
// the same axis is there.
void append_uncertain_rotations(const PathChain& chain, double limit_rad, RegistrationResult& result);

// In words, "slides along (x, y, z)" or "turns about the axis through (x, y, z) m along (x, y, z)", mesh frame.
UndeterminedMotion describe_motion(const Vector6& motion, const Eigen::Vector3d& centre_m, double sigma_m,
                                   double radius_m);

}  // namespace asperity::registration
