#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "asperity/geometry/mesh_surface.h"
#include "asperity/pipeline/register_config.h"
#include "asperity/registration/registration_iteration.h"
#include "asperity/registration/registration_surface.h"

namespace asperity {

// Which scans share a placement, as the scans themselves show it.
struct FoundPlacements {
  std::vector<std::vector<std::size_t>> groups;  // indices of the scans, in the order of their first scans
  std::vector<Pose> poses;                       // of each group
};

// The likelihood-ratio test of docs/registration.md, "Which scans share a placement": each scan is registered alone,
// from `guess` and over the whole mesh; scan after scan then joins the placement in which it raises the cost least, if
// that is less than a placement of its own is worth, and else begins one. `paths` are the scans', `smooth` the same
// without their relief. Throws Error as find_registration does, and Cancelled.
FoundPlacements find_placements(std::span<const MeasuredPath> paths, std::span<const MeasuredPath> smooth,
                                const MeshSurface& surface, const RegistrationSurface& ready,
                                const std::optional<Pose>& guess, const RegisterConfig& config,
                                const RegistrationObserver& observer = {});

}  // namespace asperity
