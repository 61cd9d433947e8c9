#pragma once

#include <span>

#include "asperity/registration/registration_result.h"
#include "asperity/registration/registration_surface.h"
#include "asperity/registration/weigh_poses.h"

namespace asperity {

struct RivalConfig {
  double same_m = 1.5e-3;   // poses nearer than this (RMS over the points)
  double same_rad = 0.044;  // and than this are one
  double surface_error_m = 2e-6;
};

// What speaks against a pose: the other poses of `found` that are not as unlikely as they would have to be, and how
// well the pose is known within its own valley. `at` is the pose itself, weighed. Another pose that the mesh's own
// symmetry maps onto this one (find_symmetry.h) is not a rival, and a motion along which the mesh maps onto itself
// leaves nothing open: both are listed as such. `searched`: `found` comes from everywhere on the mesh.
PoseRivals find_rivals(std::span<const MeasuredPath> paths, const RegistrationSurface& surface, const WeighedPose& at,
                       std::span<const WeighedPose> found, bool searched, const RivalConfig& config);

// Writes them into a result: ambiguous if the odds of the others together are above 0.01, the likeliest of them as
// runner-up, and what was compared into its verdict in words.
void state_rivals(const PoseRivals& rivals, RegistrationResult& result);

}  // namespace asperity
