#pragma once

#include <span>

#include "asperity/geometry/pose.h"
#include "asperity/registration/registration_config.h"
#include "asperity/registration/registration_iteration.h"
#include "asperity/registration/registration_result.h"
#include "asperity/registration/registration_surface.h"

namespace asperity {

// The pose T_mesh_world that lays one or several paths, rigidly joined, on a mesh: robust point-to-plane ICP from
// `guess`, annealed from the isotropic metric, with other starts where the config asks for them, and a verdict on
// what it found (thesis §5.4, Fig. 25; docs/registration.md). A motion the paths do not determine keeps the guess.
// Points that are not finite are left out and listed in the problems. Throws Error for fewer than three finite
// points (naming the first that is not), points that all coincide, a guess that is not finite, or a surface whose
// parts do not match; and Cancelled.
RegistrationResult register_path(std::span<const MeasuredPath> paths, const RegistrationSurface& surface,
                                 const Pose& guess, const RegistrationConfig& config,
                                 const RegistrationObserver& observer = {});

}  // namespace asperity
