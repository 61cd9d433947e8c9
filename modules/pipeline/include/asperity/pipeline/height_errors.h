#pragma once

#include "asperity/profile/find_base_path.h"
#include "asperity/profile/texture_noise.h"
#include "asperity/recording/recording.h"
#include "asperity/trajectory/trajectory_result.h"

namespace asperity {

// The noises of acceleration and tracker under a trajectory, along the normals of the base path and along the path. The
// acceleration's is what the data themselves show: the floor of its spectrum (measure_error_floor.h), along the normal
// at most as much as the height can have in it. The tracker's is 2 σ² times the time between two poses, σ as the
// residuals showed it (`tracker_sigma_x_m`, … of the trajectory's metrics). Nothing where the trajectory does not say
// that.
HeightErrors height_errors(const Recording& recording, const TrajectoryResult& trajectory, const BasePathResult& base);

}  // namespace asperity
