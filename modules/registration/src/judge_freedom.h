#pragma once

#include <vector>

#include "fit_pose.h"

namespace asperity::registration {

// What a fit determines, about the points' mean.
struct Freedom {
  Matrix6 covariance = Matrix6::Zero();
  Matrix6 metric = Matrix6::Zero();
  std::vector<Vector6> free;      // undetermined motions, orthonormal in the metric: slides first, then turns
  double free_sigma_m = 0.0;      // the largest standard deviation among them
  std::vector<Vector6> held;      // those of them along which the guess is to be kept
  double determined_rms_m = 0.0;  // of the points' motion over all determined ones
};

// `matcher` holds all points at `pose`, where they fit with a standard deviation sigma_m. Directions by the
// information matrix in the metric of the points' motion; weak ones are tried by sliding (docs/registration.md).
Freedom judge_freedom(const RegistrationSurface& surface, const PointSet& points, const MatchRules& rules,
                      const Matcher& matcher, const CentredPose& pose, double sigma_m,
                      const RegistrationConfig& config);

// The facets' sag below the smooth surface they stand for, RMS over the usable pairs.
double facet_sag_m(const RegistrationSurface& surface, const Matcher& matcher);

// In words, "slides along (x, y, z)" or "turns about the axis through (x, y, z) m along (x, y, z)", mesh frame.
UndeterminedMotion describe_motion(const Vector6& motion, const Eigen::Vector3d& centre_m, double sigma_m,
                                   double radius_m);

}  // namespace asperity::registration
