#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include "asperity/geometry/mesh_surface.h"
#include "asperity/geometry/pose.h"
#include "asperity/pipeline/pose_candidates.h"
#include "asperity/pipeline/scan_points.h"
#include "asperity/registration/registration_iteration.h"
#include "asperity/registration/registration_result.h"

namespace asperity {

// Where scans lie on a mesh.
struct LocatedScans {
  RegistrationResult registration;
  std::vector<std::vector<Eigen::Vector3d>> slow_error_world_m;  // [scan][point]; empty scans if none was estimated
  PoseCandidates candidates;                                     // all that was compared; empty by another method
};

// The pose of the mesh to which all scans fit (seed §5.4), from `guess` or from anywhere; refined by what is known of
// the errors along them. Throws Error if the points do not allow it at all, and Cancelled.
LocatedScans locate_scans(const ScanPoints& scans, const MeshSurface& surface, const std::optional<Pose>& guess,
                          const RegisterConfig& config, const RegistrationObserver& observer = {});

}  // namespace asperity
