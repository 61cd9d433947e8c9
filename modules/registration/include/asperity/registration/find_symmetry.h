#pragma once

#include <optional>

#include <Eigen/Geometry>

#include "asperity/geometry/pose.h"
#include "asperity/registration/registration_surface.h"

namespace asperity {

// The rigid motion near `motion` (mesh frame) that maps the mesh onto itself, if there is one: the mesh's own points,
// moved so, are fitted to it (register_path.h's steps), and end nearer to it than the sag of its facets,
// `surface_error_m` or 0.0002 of its size allow, 995 of 1000 of them. Motions from which that fit ends elsewhere find
// what is there: compare the two. The identity maps each mesh onto itself. Not found for a mesh without area.
std::optional<Pose> find_symmetry(const RegistrationSurface& surface, const Pose& motion, double surface_error_m);

// Whether the mesh is its own image by a reflection near the given one (linear part of determinant −1, m), by the same
// measure.
bool is_own_image(const RegistrationSurface& surface, const Eigen::Affine3d& reflection, double surface_error_m);

}  // namespace asperity
