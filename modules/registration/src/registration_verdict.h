#pragma once

#include "fit_pose_fully.h"

namespace asperity::registration {

enum class TriedStarts { kNone, kAboutGuess, kEverywhere };

struct RegistrationFindings {
  const ConvergedPose& best;
  double noise_m = 0.0;  // of the path and the mesh's facets
  TriedStarts tried = TriedStarts::kNone;
  bool runner_up_fits = false;  // as well as the best
};

// Everything of `out` but iterations, runner-up and the problems met so far. `used` points entered the fit.
void write_registration_verdict(const RegistrationFindings& findings, const PointSet& points, std::size_t used,
                                const RegistrationConfig& config, RegistrationResult& out);

}  // namespace asperity::registration
