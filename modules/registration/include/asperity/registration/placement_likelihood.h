#pragma once

#include <span>

#include "asperity/registration/registration_config.h"
#include "asperity/registration/registration_result.h"
#include "asperity/registration/registration_surface.h"
#include "asperity/registration/weigh_poses.h"

namespace asperity {

// Paths in one placement: their likeliest pose, and the logarithm of their evidence, the mean of their likelihood over
// all poses of the mesh.
struct PlacementFit {
  Pose T_mesh_world;
  double log_evidence = 0.0;
};

// Whether paths share a placement is asked of the likelihood of weigh_poses.h: heights over blocks of path, each path
// with a noise and a mean of its own, so that the relief, which says nothing of the pose, has no part in it. With
// L(T) the likelihood of some paths at the pose T and p = 1/Ω before, Ω = 8π² (rotations, rad³) times the volume of the
// box about the mesh (m³), their evidence is
//   E = ∫ L(T) p dT ≈ L(T₁) Ω⁻¹ (2π)³ |H|^(−1/2)
// at the deepest valley T₁, H the information there (Laplace). Paths a and b share a placement with the odds
// E(a, b) : E(a) E(b). The factor Ω (2π)⁻³ |H|^(1/2) is what a pose of its own has to gain (some e³⁰): a path that
// hardly determines its pose has to gain less. (Schwarz's 6 ln N is its large-sample form.)
// The deepest valley is looked for from each start. Throws Error as weigh_poses does, and Cancelled.
PlacementFit fit_placement(std::span<const MeasuredPath> paths, const RegistrationSurface& surface,
                           std::span<const Pose> starts, const WeighConfig& config,
                           const RegistrationConfig& registration);

// Of poses that have been weighed; at least one.
PlacementFit best_placement(std::span<const WeighedPose> found, const RegistrationSurface& surface);

}  // namespace asperity
