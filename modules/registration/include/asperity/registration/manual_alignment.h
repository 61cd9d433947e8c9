#pragma once

#include <array>
#include <span>

#include "asperity/geometry/pose.h"
#include "asperity/registration/absolute_orientation.h"

namespace asperity {

// The six numbers of an alignment by hand (thesis §5.4, Fig. 23).
struct ManualAlignment {
  std::array<double, 3> shift_m{};       // x, y, z of the world frame's origin in the mesh frame
  std::array<double, 3> rotation_deg{};  // about x, then the rotated y, then the twice rotated z
};

// T_mesh_world with p_mesh = Rx(rotation[0]) Ry(rotation[1]) Rz(rotation[2]) p_world + shift. Throws Error for a number
// that is not finite.
Pose align_manually(const ManualAlignment& alignment);

// The six numbers of a pose, rotations within ±180°, ±90°, ±180°; at a middle rotation of ±90° the third is 0.
ManualAlignment manual_alignment(const Pose& T_mesh_world);

// T_mesh_world from at least three pairs of points that were picked on the path and on the mesh: the absolute
// orientation of the pairs, its rms_m saying how well they match. Throws Error as absolute_orientation does,
// and for pairs on a line.
AbsoluteOrientation align_picked(std::span<const Eigen::Vector3d> p_world_m, std::span<const Eigen::Vector3d> p_mesh_m);

}  // namespace asperity
