#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "asperity/recording/calibration.h"

namespace asperity {

// The sensor's acceleration in the world frame without gravity, m/s²: f = B⁻¹(counts − C) once, then
// a_world = R_world_marker f + gravity_world, gravity added once (thesis §4.3, B.1, erratum 4).
// One entry a sample. Throws Error if the sizes differ or B is singular.
std::vector<Eigen::Vector3d> remove_gravity(std::span<const Eigen::Vector3d> accel_counts,
                                            std::span<const Eigen::Quaterniond> q_world_marker,
                                            const AccelerometerCalibration& calibration,
                                            const Eigen::Vector3d& gravity_world_mps2);

}  // namespace asperity
