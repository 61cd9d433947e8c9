#pragma once

#include <array>
#include <span>

#include <Eigen/Core>

#include "bvh_layout.h"

namespace asperity::bvh {

// Sets the oriented box of a leaf to hold its triangles, whose corners are given from its origin, in its units: one
// axis is the sum of the normals, the others are the principal axes of the corners across it.
void set_oriented_box(std::span<const std::array<Eigen::Vector3d, 3>> triangles, LeafHead& head);

}  // namespace asperity::bvh
