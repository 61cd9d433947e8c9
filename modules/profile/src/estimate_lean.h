#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

#include "asperity/geometry/motion.h"
#include "asperity/profile/base_path.h"
#include "path_evidence.h"

namespace asperity {

// How far a base's normals lean about the direction of travel: the surface's own are n cos φ + b sin φ, b the unit
// vector across travel and n.
struct Lean {
  double lean_rad = 0.0;
  double sigma_rad = 0.0;
};

// What a base fitted to the path says of it by itself.
struct LeanPrior {
  double sigma_rad = 0.0;               // about 0
  double texture_axis_sigma_rad = 0.0;  // BasePathConfig; 0: the fine motion is not used
};

// The posterior of φ, on a grid, from three independent sources (docs/profile.md, "How far the normals lean"):
//
// The base's prior, N(0, σ₀²).
//
// The motion from 4 to 60 Hz. Across the path (w, a hand's tremor) and along the surface's normal (h, its texture) have
// nothing to do with each other, whatever their spectra. With a_n and a_b the accelerations off the base along n and b,
// a third-octave band of N_k independent Fourier coefficients has the powers
//     H_k(φ) = Σ |a_n cos φ + a_b sin φ|²,   W_k(φ) = Σ |a_b cos φ − a_n sin φ|²
// and, the spectra unknown (Jeffreys' prior), the likelihood Π_k (H_k W_k)^−N_k: it is highest where the two are not
// correlated. A hand gives way sideways to a texture, by `texture_axis_sigma_rad`; a tremor over a smooth surface has
// no such error. By how much of the information is of the one or the other kind, the likelihood is widened.
//
// A force sensor of three axes: friction is along travel, so the force across it is N sin φ.
//
// `base` has the base points and normals of each sample; `across` b, of each sample.
Lean estimate_lean(const TipMotion& motion, std::span<const double> t_s, std::span<const char> contact,
                   const PathEvidence& evidence, const BasePath& base, std::span<const Eigen::Vector3d> across,
                   const LeanPrior& prior);

}  // namespace asperity
