#pragma once

#include <optional>
#include <string>
#include <string_view>

#include <Eigen/Core>

#include "asperity/import/file_streams.h"

namespace asperity {

// All that one import brings, of one body, on one clock.
struct ImportStreams {
  PoseStream pose;
  VectorStream specific_force;  // m/s², f = a − g
  VectorStream rate;            // rad/s; empty: there is no gyroscope
  ScalarStream force;           // N, along the force axis; empty: none
  VectorStream force3;          // N; empty: none
  Problems problems;
};

// The world's axis that `name` (x, -y, …) states, as a unit vector. Throws Error for another name.
Eigen::Vector3d axis_vector(std::string_view name, std::string_view what);

// The matrix that brings the sensor's vectors into the body's axes: "y,-x,z" (the body's x is the sensor's y, …) or a
// quaternion "qw,qx,qy,qz" that rotates the sensor's coordinates into the body's. Throws Error for other text.
Eigen::Matrix3d sensor_axes(std::string_view text);

// Poses of a left-handed world and body as those of their mirror image: one axis is negative in both, z, or y where z
// points up. Specific force and rate are given in the sensor's axes and stay.
void mirror_poses(PoseStream& pose, std::string_view up);

// Brings specific force and rate into the body's axes by sensor_axes. A mirrored sensor (determinant −1) has its rates,
// which are axial vectors, mirrored with the other sign.
void turn_sensor(ImportStreams& streams, const Eigen::Matrix3d& axes);

// The world rotated so that `up` points along +z.
void turn_world(PoseStream& pose, const Eigen::Vector3d& up);

// The mean specific force in the world's axes, m/s²: −g and the mean acceleration, which is small where the hand stays
// in a room; nullopt if fewer than eight samples have a pose.
std::optional<Eigen::Vector3d> mean_force_in_world(const ImportStreams& streams);

}  // namespace asperity
