#pragma once

#include <Eigen/Core>

#include "asperity/render/near_triangles.h"
#include "asperity/render/render_model.h"

namespace asperity {

// Fills `near` with the model's triangles that have a point within `radius_m` of a point of the world, in the order of
// objects and trees. False if there are more than it holds: then it holds some of them. `only`: of that object
// alone, if it is one.
bool gather(const RenderModel& model, const Eigen::Vector3d& centre_m, double radius_m, std::uint32_t only,
            NearTriangles& near) noexcept;

}  // namespace asperity
