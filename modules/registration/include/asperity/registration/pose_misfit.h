#pragma once

#include <optional>
#include <span>

#include "asperity/registration/registration_result.h"
#include "asperity/registration/registration_surface.h"

namespace asperity {

struct PoseMisfitConfig {
  double slow_length_m = 20e-3;   // over which distances are averaged
  double surface_error_m = 2e-6;  // of the mesh, in addition to its facets' sag
  double guess_sigma_m = 20e-3;
  double guess_sigma_rad = 0.35;
  bool guess_stated = true;
};

// How far the paths at the pose `result.T_mesh_world` are from the mesh, and what of that is explained. The signed
// distance d of a point over the mesh is parted into its mean over slow_length_m of path about it and the rest, the
// relief. The mean can come from the paths' drift (their covariance along the normal), the sag of the facets and
// the error of the mesh, and the relief's own mean, which is known to the relief's RMS (a board's holes lie under its
// face). Both parts are RMS values over the points that are nearer than four robust standard deviations; points beyond
// a border of the mesh do not count. With fewer than ten points all this is nan. `off_share`: of the points whose mean
// distance over slow_length_m is above 6 robust standard deviations and 3 % of the path's extent. `guess`: the pose
// that the registration began from, if it was given.
PoseMisfit measure_pose_misfit(std::span<const MeasuredPath> paths, const RegistrationSurface& surface,
                               const std::optional<Pose>& guess, const PoseMisfitConfig& config,
                               const RegistrationResult& result);

}  // namespace asperity
