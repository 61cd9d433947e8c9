#pragma once

#include <cstdint>

#include <Eigen/Core>

#include "asperity/render/near_triangles.h"
#include "asperity/render/render_model.h"

namespace asperity {

// A set of a model's objects: bit k is object k.
using ObjectSet = std::uint64_t;
inline constexpr ObjectSet kAllObjects = ~ObjectSet{0};

// Fills `near` with the triangles of these objects that have a point within `radius_m` of a point of the world, in the
// order of objects and trees. False if there are more than it holds: then it holds some of them.
bool gather_triangles(const RenderModel& model, const Eigen::Vector3d& centre_m, double radius_m, ObjectSet objects,
                      NearTriangles& near) noexcept;

// Puts one more triangle of the model at the end of a list. False if the list is full or has it already.
bool add_triangle(const RenderModel& model, std::uint32_t object, std::uint32_t triangle, NearTriangles& near) noexcept;

}  // namespace asperity
