#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

#include "asperity/profile/base_path.h"

namespace asperity {

// The path laid out flat: its points at the arc lengths `s_m` (m, rising) in a plane, m. Between points of the base
// path about 1 mm apart the pieces keep their lengths (all alike as much longer as the arc length is than they), and
// from one piece to the next the heading changes by their angle in the tangent plane there, counted about the outward
// normal: the geodesic curvature's integral (do Carmo, Differential Geometry of Curves and Surfaces, 4-4). Of a path in
// a plane this is the path itself, of one on a cylinder or a cone the path on the unrolled sheet; on other bodies
// straight lines of the sheet are no straight lines of the surface. The first piece is along x. Empty for a path
// shorter than two pieces.
std::vector<Eigen::Vector2d> unroll_path(const BasePath& path, std::span<const double> s_m);

}  // namespace asperity
