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
  // [scan]: by what the tip is to be shifted in the marker, and what is left of its standard deviation, marker axes;
  // empty if the method does not estimate it.
  std::vector<Eigen::Vector3d> tip_shift_m, tip_sigma_m;
  std::vector<double> rms_m;                    // [scan]: of the heights over the mesh; nan: not known
  double bulge_share = 0.0, bulge_sigma = 0.0;  // of the facets (refine_placements.h)
  std::size_t crossings = 0;                    // where scans met, by their heights
  std::size_t matched_shifts = 0;               // and by their textures
  std::vector<PoseCandidates> candidates;  // of each placement: all that was compared; empty ones by another method
};

// The poses of the mesh to which the scans of each placement fit (seed §5.4, B.2), from `guess` or from anywhere;
// refined by what is known of the errors along them, all placements together. Which scans share a placement is stated,
// or a setting, or found (find_placements.h). With several placements the guess is one of each that it fits: where it
// is more than its stated error off, the placement is searched for. Throws Error if the points do not allow it at all,
// and Cancelled.
LocatedScans locate_scans(const ScanPoints& scans, const MeshSurface& surface, const std::optional<Pose>& guess,
                          const RegisterConfig& config, const RegistrationObserver& observer = {});

}  // namespace asperity
