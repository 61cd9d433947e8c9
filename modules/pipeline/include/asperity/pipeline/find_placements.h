#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "asperity/pipeline/register_config.h"
#include "asperity/pipeline/scan_points.h"
#include "asperity/registration/registration_iteration.h"
#include "asperity/registration/registration_surface.h"

namespace asperity {

// Which scans share a placement, as the scans themselves show it.
struct FoundPlacements {
  std::vector<std::vector<std::size_t>> groups;  // indices of the scans, in the order of their first scans
  std::vector<Pose> poses;                       // of each group
};

// The test of docs/registration-placements.md, "Which scans share a placement": each scan is registered alone, from
// `guess` and over the whole mesh; scan after scan then joins the placement to which it belongs by the largest odds
// (placement_likelihood.h), if these are above one, and else begins one. Throws Error as find_poses does, and
// Cancelled.
FoundPlacements find_placements(const ScanPoints& scans, const RegistrationSurface& ready,
                                const std::optional<Pose>& guess, const RegisterConfig& config,
                                const RegistrationObserver& observer = {});

}  // namespace asperity
