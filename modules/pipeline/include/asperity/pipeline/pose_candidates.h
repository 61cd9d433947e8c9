#pragma once

#include <optional>
#include <span>
#include <vector>

#include "asperity/geometry/mesh_surface.h"
#include "asperity/geometry/pose.h"
#include "asperity/pipeline/register_config.h"
#include "asperity/pipeline/scan_points.h"
#include "asperity/registration/registration_iteration.h"
#include "asperity/registration/registration_result.h"
#include "asperity/registration/registration_surface.h"
#include "asperity/registration/weigh_poses.h"

namespace asperity {

// The poses at which scans may lie on a mesh, with the probability of each.
struct PoseCandidates {
  std::vector<WeighedPose> found;  // the likeliest first; at least one
  bool everywhere = false;         // poses anywhere on the mesh are among them
};

// How the poses of scans are compared.
WeighConfig weigh_config(const ScanPoints& scans, const std::optional<Pose>& guess, const RefineConfig& refine);

// Those in reach of `near` and, without a guess or where the settings ask for rivals, those anywhere on the mesh
// (find_poses, weigh_poses). Throws Error as find_poses does, and for no pose at all; and Cancelled.
PoseCandidates find_pose_candidates(const ScanPoints& scans, const RegistrationSurface& surface,
                                    const std::optional<Pose>& guess, std::span<const Pose> near,
                                    const RegisterConfig& config, const RegistrationObserver& observer = {});

// What speaks against a pose, however it was come by, of all `candidates` of the same scans (find_rivals).
PoseRivals judge_candidate(const ScanPoints& scans, const RegistrationSurface& surface, const Pose& T_mesh_world,
                           const std::optional<Pose>& guess, const PoseCandidates& candidates,
                           const RegisterConfig& config);

// A pose that no registration has come to: how the scans lie there, and what speaks against it. It is taken as it is.
RegistrationResult judge_pose_by_hand(const ScanPoints& scans, const MeshSurface& surface, const Pose& T_mesh_world,
                                      const PoseCandidates& candidates, const RegisterConfig& config);

}  // namespace asperity
