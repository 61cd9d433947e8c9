#pragma once

#include <span>

#include "asperity/registration/registration_config.h"
#include "asperity/registration/registration_surface.h"
#include "asperity/registration/weigh_poses.h"

namespace asperity {

// Whether the paths tell the mesh from its mirror image: the logarithm of the odds of the image to the mesh, equal
// probabilities before (the masses of weigh_poses.h). A path lies on the image of a mesh as its own image lies on the
// mesh, so the paths are reflected, about their mean, in the plane across their least extent, and weighed at the poses
// of `at` (the first is the one in question) and at these after half a turn about the other two principal axes, which
// is what a reflection in another of the principal planes amounts to. Well below 0 the mesh has the right hand; near 0
// the paths are their own image to within their errors, and say nothing of it; above 0 the object is rather the image.
// An image at quite another place is not looked for. nan where the mesh is its own image by that reflection
// (find_symmetry.h). Throws Error as register_path does.
double weigh_mirror_image(std::span<const MeasuredPath> paths, const RegistrationSurface& surface,
                          std::span<const WeighedPose> at, const WeighConfig& config,
                          const RegistrationConfig& registration);

}  // namespace asperity
