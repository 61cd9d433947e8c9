#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "asperity/base/problem.h"
#include "asperity/geometry/mesh_path.h"
#include "asperity/geometry/pose.h"
#include "asperity/geometry/triangle_mesh.h"
#include "asperity/pipeline/path_texture.h"
#include "asperity/pipeline/placement.h"
#include "asperity/pipeline/process_result.h"
#include "asperity/pipeline/register_config.h"
#include "asperity/pipeline/scan.h"
#include "asperity/recording/fingerprint.h"
#include "asperity/registration/haptic_coordinates.h"
#include "asperity/registration/registration_iteration.h"
#include "asperity/registration/registration_result.h"
#include "asperity/texture/texture.h"
#include "asperity/verdict/verdict.h"

namespace asperity {

// A scan in its place on the mesh.
struct RegisteredScan {
  std::string name;
  bool is_recording = false;
  Fingerprint fingerprint;                                  // of what it was measured from
  std::size_t placement = 0;                                // index of its placement
  double rms_m = std::numeric_limits<double>::quiet_NaN();  // of its heights over the mesh, as the pose's fit has them
  Eigen::Vector3d tip_shift_m = Eigen::Vector3d::Zero();    // by which the fit moved the tip in the marker, marker axes
  std::optional<Eigen::Vector3d> tip_sigma_m;               // what is left of its error; nullopt: not estimated
  ProcessResult process;                                    // of a path alone: motion, base path and profile
  MeshPath path;                                            // its s_m is the profile's
  std::optional<PathTexture> path_texture;  // the whole profile; nullopt if a texture was given or none could be made
  std::optional<Texture> texture;           // what is laid along the path
};

// Scans registered to a mesh, measured over it, and its haptic coordinates: texture i + 1 is that of scan i.
struct ScansOnMesh {
  std::vector<Placement> placements;  // at least one, in the order of their first scans
  std::vector<RegisteredScan> scans;
  double bulge_share = 0.0, bulge_sigma = 0.0;  // of the mesh's facets that the object has (refine_placements.h)
  std::size_t crossings = 0;                    // where scans met on the mesh, and their heights counted
  std::size_t matched_shifts = 0;               // where their textures gave a shift along the path
  std::vector<RepeatedLine> lines;              // that paths are over more than once, of one scan or of several
  HapticCoordinates coordinates;
  Problems problems;
  Verdicts verdicts;        // of the pose and of each scan, the worst first; docs/verdicts.md
  bool trustworthy = true;  // none of them is invalid
  std::string verdict;      // they in a sentence; empty if none is invalid or limited
  RegisterConfig config;    // the settings that gave it

  const RegistrationResult& registration_of(const RegisteredScan& scan) const {
    return placements[scan.placement].registration;
  }
};

// From scans and a mesh to a textured mesh (seed §5.4, §6.3, B.2): the tips' trajectories; the pose of the mesh to
// which all scans of a placement fit, from `guess` or from anywhere; the profiles over the mesh (seed §4.3); textures
// and haptic coordinates. `mesh` is in metres. Throws Error if a scan or a setting does not allow it at all, naming the
// scan, and Cancelled.
ScansOnMesh register_scans(const std::vector<Scan>& scans, const TriangleMesh& mesh, const std::optional<Pose>& guess,
                           const RegisterConfig& config, const RegistrationObserver& observer = {});

}  // namespace asperity
