#pragma once

#include <vector>

#include "fit_pose_fully.h"

namespace asperity::registration {

// What all solutions of one registration share.
struct SolutionContext {
  const RegistrationSurface& surface;
  const PointSet& points;
  const MatchRules& rules;
  const FitOptions& options;
  const RegistrationConfig& config;
  double noise_m = 0.0;
  IterationWatch& watch;
};

// Below this z the runner-up fits as well.
inline constexpr double kAmbiguousZ = 3.0;

// Settles from each pose; `best` becomes the best of all, `out` gets the best of the rest that is another place as its
// runner-up, and the iterations. Returns the z by which the runner-up is worse.
double compare_solutions(const SolutionContext& context, Matcher& fine, const std::vector<CentredPose>& poses,
                         ConvergedPose& best, RegistrationResult& out);

}  // namespace asperity::registration
