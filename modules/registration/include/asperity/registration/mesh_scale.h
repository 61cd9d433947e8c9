#pragma once

#include <span>

#include "asperity/registration/registration_config.h"
#include "asperity/registration/registration_result.h"
#include "asperity/registration/registration_surface.h"
#include "asperity/registration/weigh_poses.h"

namespace asperity {

// At which size of the mesh the paths fit it best. On a mesh of the true size r times its own, the height of a point x
// is r d(R x/r + t), d the distance from the mesh as it is; r is one more unknown of the likelihood of weigh_poses.h,
// with a log-normal prior about 1 (standard deviation of the logarithm: 0.5). Of the descents from each of `starts` and
// from other sizes at the first the likeliest counts. Its standard error has in it the errors along the paths, as large
// as they are at that size, and the tip's calibrated position (`tip_sigma_m` of the paths; a tip that is too long makes
// an object too large). A mesh that is a quarter too large or small may end at a maximum between; that it is not the
// right size shows all the same. What the paths do not tell has a large one: a plane has any size.
MeshScale measure_mesh_scale(std::span<const MeasuredPath> paths, const RegistrationSurface& surface,
                             std::span<const WeighedPose> starts, const WeighConfig& config,
                             const RegistrationConfig& registration);

}  // namespace asperity
