#pragma once

#include <span>

#include "asperity/geometry/pose.h"
#include "asperity/trajectory/calibrate_inertial.h"
#include "asperity/trajectory/estimate_trajectory_fused.h"
#include "inertial_smoother.h"

namespace asperity::inertial_smoother {

// Lays the samples from `begin_s` on, and the poses at their true times `pose_s` (rising) that lie among them, on one
// time line that begins at `begin_s` and ends with the last sample. Times are seconds after the first sample of
// `inertial`; `begin_s` lies before its last one. `first_pose_counts`: a pose at begin_s itself is measured; it is
// not where the filter has been told of it already.
Problem make_window(const InertialStream& inertial, const FusedConfig& config, double begin_s,
                    std::span<const double> pose_s, std::span<const Pose> T_world_marker, bool first_pose_counts);

}  // namespace asperity::inertial_smoother
