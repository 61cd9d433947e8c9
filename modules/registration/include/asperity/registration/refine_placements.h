#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "asperity/geometry/mesh_surface.h"
#include "asperity/registration/refine_registration.h"

namespace asperity {

// What all paths of all placements give together.
struct RefinedPlacements {
  std::vector<RegistrationResult> registrations;                 // one a placement
  std::vector<std::vector<Eigen::Vector3d>> slow_error_world_m;  // [path][point]; empty paths if none was estimated
  // [path]: by what the tip is to be shifted in the marker, marker axes, and the standard deviation that is left; zero
  // where the position was exact or unknown.
  std::vector<Eigen::Vector3d> tip_shift_m, tip_sigma_m;
  std::vector<double> rms_m;  // [path]: of the heights over the mesh
  // The share of the facets' bulge (facet_bulge_m) that the object has: 0 if it is as flat between the vertices as the
  // mesh, 1 if it is as round as the vertices' normals; and its standard deviation.
  double bulge_share = 0.0, bulge_sigma = 0.0;
  std::size_t crossings = 0;  // overlaps by height and by texture that took part
  std::size_t shifts = 0;
};

// The poses of all placements at once, from those that refine_registration gave one by one
// (docs/registration-placements.md): the tip's position, which all scans of a session share, the slow errors, the mean
// reliefs and the poses are the unknowns of one sparse least-squares problem; where paths meet on the mesh, their
// heights and their textures link them. `placement_of` has an index into `starts` for each path, `guesses` one a
// placement or is empty. The normal equations are factored by Eigen's sparse L D Lᵀ on one thread, in an order that
// depends on their pattern alone: the same input gives the same bytes. Throws Cancelled.
RefinedPlacements refine_placements(std::span<const MeasuredPath> paths, std::span<const std::size_t> placement_of,
                                    const MeshSurface& surface, std::span<const RegistrationResult> starts,
                                    std::span<const std::optional<Pose>> guesses, const RefineConfig& config,
                                    const RegistrationObserver& observer = {});

}  // namespace asperity
