#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "asperity/base/problem.h"
#include "asperity/geometry/motion.h"

namespace asperity {

// A path read from a file, and what was wrong with the file.
struct PathFile {
  TipMotion motion;
  bool timed = false;     // the file has t_ns; without it, times are the row numbers
  bool oriented = false;  // the file has qw,qx,qy,qz
  Problems problems;
};

// Reads a trajectory.csv or any CSV with the columns px_m,py_m,pz_m (m, world frame), and, where it has
// them, t_ns (rising), qw,qx,qy,qz, vx_mps,vy_mps,vz_mps, force_N and the positions' standard deviations:
// sigma_x_m,sigma_y_m,sigma_z_m of the world axes or sigma_m of each axis, which become the motion's covariances. If
// they are nan or zero in any row, the path has no stated errors. Rows whose position is nan are passed
// over and counted. Throws Error naming file, line and column for a missing column, a cell that is not a
// number, times that do not rise, no row at all, or a file over 1 GiB.
PathFile read_path(const std::filesystem::path& file);
// The same from text; `name` is what messages call the file.
PathFile parse_path(std::string_view text, const std::string& name);

}  // namespace asperity
