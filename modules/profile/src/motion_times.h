#pragma once

#include <vector>

#include <Eigen/Core>

#include "asperity/geometry/motion.h"
#include "asperity/profile/find_base_path.h"

namespace asperity {

// Seconds from the first sample. Throws Error for a motion that no base path can be found under.
std::vector<double> motion_times_s(const TipMotion& motion);

// Fills arc length, speed, turning points and length of `out` from its contact marks and the coordinates on the
// developed base shape, one a sample.
void follow_path(const TipMotion& motion, const std::vector<double>& t_s, const std::vector<Eigen::Vector2d>& developed,
                 const BasePathConfig& config, BasePathResult& out);

}  // namespace asperity
