#pragma once

#include <vector>

#include "find_unobservable_dofs.h"
#include "fit_pose.h"

namespace asperity::registration {

// A pose at which all points fit as well as they do nearby, and what is known there.
struct ConvergedPose {
  CentredPose pose;
  Fit fit;                          // the last one
  double sigma_m = 0.0;             // RMS distance of the inliers, with six degrees of freedom taken off
  double rms_m = 0.0;               // the same without
  double mean_m = 0.0;              // of |distance| over all points with a closest point
  std::size_t outliers = 0;         // pairs that do not count or lie too far
  std::vector<double> distances_m;  // signed; nan where the pair does not count
  Observability observability;
};

// Fits all points of `matcher` from `start`, finds what is undetermined there and puts that back to the guess
// (`options.reference`).
ConvergedPose fit_pose_fully(const RegistrationSurface& surface, const PointSet& points, const MatchRules& rules,
                             Matcher& matcher, const CentredPose& start, FitOptions options,
                             const RegistrationConfig& config);

// Standard deviation along the normal of the points' own noise, from second differences across the surface at
// `pose`; the given one if there is one.
double path_noise_m(const PointSet& points, const Matcher& matcher, const CentredPose& pose);

// The mean robust cost, 0 to 1, of distances as in ConvergedPose.
double robust_mean(const std::vector<double>& distances_m, double width_m);

// z of the mean excess of b's robust cost over a's: over its standard error from twenty stretches of the path
// (Vuong 1989). Distances as in ConvergedPose, of the same points.
double excess_z(const std::vector<double>& a_m, const std::vector<double>& b_m, double width_m);

}  // namespace asperity::registration
