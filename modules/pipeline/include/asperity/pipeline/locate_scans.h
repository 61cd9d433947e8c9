#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include "asperity/geometry/mesh_surface.h"
#include "asperity/geometry/pose.h"
#include "asperity/pipeline/placement.h"
#include "asperity/pipeline/pose_candidates.h"
#include "asperity/pipeline/scan_points.h"
#include "asperity/registration/registration_iteration.h"
#include "asperity/registration/registration_result.h"

namespace asperity {

// Where scans lie on a mesh.
struct LocatedScans {
  std::vector<Placement> placements;      // at least one; each scan is in one of them; their verdicts are empty
  std::vector<std::size_t> placement_of;  // index of each scan's placement
  std::vector<std::vector<Eigen::Vector3d>> slow_error_world_m;  // [scan][point]; empty scans if none was estimated
  std::vector<PoseCandidates> candidates;  // of each placement: all that was compared; empty ones by another method
};

// The poses of the mesh to which the scans of each placement fit (seed §5.4, B.2), from `guess` or from anywhere;
// refined by what is known of the errors along them. Throws Error if the points do not allow it at all, and Cancelled.
LocatedScans locate_scans(const ScanPoints& scans, const MeshSurface& surface, const std::optional<Pose>& guess,
                          const RegisterConfig& config, const RegistrationObserver& observer = {});

}  // namespace asperity
