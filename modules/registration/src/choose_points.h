#pragma once

#include <cstdint>
#include <vector>

#include "fit_pose.h"

namespace asperity::registration {

// Indices of about `count` of the points in ascending order, at equal lengths along the paths; all if there are no more.
std::vector<std::uint32_t> choose_uniform(const PointSet& points, std::size_t count);

}  // namespace asperity::registration
