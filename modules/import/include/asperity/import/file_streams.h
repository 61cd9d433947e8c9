#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "asperity/base/problem.h"
#include "asperity/geometry/pose.h"
#include "asperity/import/import_table.h"

namespace asperity {

// Vectors with their times, which rise strictly.
struct VectorStream {
  std::vector<std::int64_t> t_ns;
  std::vector<Eigen::Vector3d> value;

  std::size_t size() const { return t_ns.size(); }
};

struct PoseStream {
  std::vector<std::int64_t> t_ns;
  std::vector<Pose> T_world_body;

  std::size_t size() const { return t_ns.size(); }
};

struct ScalarStream {
  std::vector<std::int64_t> t_ns;
  std::vector<double> value;

  std::size_t size() const { return t_ns.size(); }
};

// The rows of a table as streams in SI units, in order of time. Rows in which one of the values is missing are left
// out, so are later rows of an equal time, and both are counted in `problems`. `letter` is a, g or f. Throws Error
// naming file, line and column for text where a number should be, and if a column that is needed is not in the map or
// no row is left.
VectorStream read_vectors(const ImportTable& in, char letter, Problems& problems);
ScalarStream read_scalars(const ImportTable& in, const char* meaning, Problems& problems);

// Poses from positions and quaternions, Euler angles, rotation vectors or matrices, in the file's own axes. Throws
// Error as above, and for numbers that are not a rotation (a quaternion whose length is not 1 within 5 %, a matrix that
// is not orthonormal, in more than half of the rows; fewer are left out).
PoseStream read_poses(const ImportTable& in, const MappingConfig& config, Problems& problems);

// The rotation by Euler angles about the body's axes x, y, z, rad, in the order that `order` names ("zyx": about z
// first): intrinsic, each about the axis as the angles before it turned it, or extrinsic, about the axes that stay.
Eigen::Quaterniond euler_rotation(const Eigen::Vector3d& angles_rad, const std::string& order, EulerAxes axes);

}  // namespace asperity
