#pragma once

#include <cstdint>

#include <Eigen/Core>

#include "asperity/scene/scene.h"

namespace asperity {

// The material at a point of a triangle: of each property the map's value, interpolated over the corners that have
// one; else the texture's; else the scene's; else nan. Throws Error for a triangle out of range.
Material material_at(const Scene& scene, const SceneObject& object, std::uint32_t triangle,
                     const Eigen::Vector3d& barycentric);

}  // namespace asperity
