#pragma once

#include "asperity/geometry/pose.h"
#include "asperity/registration/registration_config.h"
#include "asperity/registration/registration_result.h"
#include "asperity/registration/registration_surface.h"
#include "asperity/registration/weigh_poses.h"

namespace asperity {

// The drift of a path whose errors nobody has stated, from its heights over the mesh at a pose: a Gauss–Markov process
// along the path, alike on each axis (weigh_poses.h), of the size and length of largest restricted likelihood
// (Patterson and Thompson 1971), since the pose was fitted to the same heights. A priori the logarithm of the length is
// that of config.slow_length_m ± 0.7, and the logarithm of the size about 0.002 of the path's radius ± 1.5. The size is
// the root of the expected square: what the path leaves open of it is in it. Throws Error as register_path does.
AssumedDrift estimate_drift(const MeasuredPath& path, const RegistrationSurface& surface, const Pose& T_mesh_world,
                            const WeighConfig& config, const RegistrationConfig& registration);

}  // namespace asperity
