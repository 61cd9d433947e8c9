#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

#include "asperity/geometry/motion.h"
#include "asperity/profile/base_path.h"
#include "path_evidence.h"

namespace asperity {

// How far a base's normals lean about the direction of travel: the surface's own are n cos φ + b sin φ, b the unit
// vector across travel and n, with φ = lean + change · (LeanAxes::change).
struct Lean {
  double lean_rad = 0.0;
  double sigma_rad = 0.0;  // of φ over the path, RMS
  double change_rad = 0.0;
};

// Of each sample.
struct LeanAxes {
  std::vector<Eigen::Vector3d> across;  // b
  std::vector<double> change;           // how a lean that changes goes over the path: mean 0, RMS 1; empty: none does
};

// What a base fitted to the path says of it by itself: standard deviations about 0.
struct LeanPrior {
  double sigma_rad = 0.0;
  double change_sigma_rad = 0.0;
  double texture_axis_sigma_rad = 0.0;  // BasePathConfig; 0: the fine motion is not used
};

// The posterior of φ from three independent sources (docs/profile-lean.md):
//
// The base's prior, N(0, σ₀²).
//
// The motion from 4 to 60 Hz. Across the path (w, a hand's tremor) and along the surface's normal (h, its texture) have
// nothing to do with each other, whatever their spectra. With a_n and a_b the accelerations off the base along n and b,
// a third-octave band of N_k independent Fourier coefficients has the powers
//     H_k(φ) = Σ |a_n cos φ + a_b sin φ|²,   W_k(φ) = Σ |a_b cos φ − a_n sin φ|²
// and, the spectra unknown (Jeffreys' prior), the likelihood Π_k (H_k W_k)^−N_k: it is highest where the two are not
// correlated. Where the sensors' noise is known (lean_bands.h), it is in both: a coefficient has the covariance
//     S(φ) = diag(H − s E_nn, W − s E_bb)⁺ + s E(φ)
// with E the noise's covariance along and across the normals that lean by φ, ⁺ for values below 0 put to 0, and the
// likelihood is Π_k det S^−N_k exp(−N_k tr S⁻¹C), C the measured covariance: it is highest where what is left when the
// noise is taken off is not correlated, says nothing where nothing is left, and is the former where there is no noise.
// Noise on a lever is across the lever: without this it is a tremor about normals along the probe. Its scale s is
// known to a factor of four, and the likeliest one is taken in each band and at each angle. A tip that
// gives way sideways by γ of the texture turns a band by γ H/(H − W): little where the tremor is the stronger, more
// than γ where the texture is. γ is known to `texture_axis_sigma_rad`; the likelihoods of both kinds of bands are
// widened by it.
//
// A force sensor of three axes: friction is along travel, so the force across it is N sin φ.
Lean estimate_lean(const TipMotion& motion, std::span<const double> t_s, std::span<const char> contact,
                   const PathEvidence& evidence, const BasePath& base, const LeanAxes& axes, const LeanPrior& prior);

}  // namespace asperity
