#pragma once

#include <cstdint>
#include <vector>

#include "fit_pose.h"

namespace asperity::registration {

// Indices of about `count` of the points in ascending order, at equal lengths along the paths; all if there are no
// more.
std::vector<std::uint32_t> choose_uniform(const PointSet& points, std::size_t count);

// The same by the method asked for, normals being those of the mesh under the points at `guess`.
std::vector<std::uint32_t> choose_points(const RegistrationSurface& surface, const PointSet& points,
                                         const CentredPose& guess, PathSampling sampling, std::size_t count);

}  // namespace asperity::registration
