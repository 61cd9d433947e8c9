#pragma once

#include "asperity/recording/recording.h"
#include "asperity/simulation/simulation_config.h"

namespace bench {

// The least RMS position error of the tip, the three axes together, m, that any estimate from this recording's streams
// can have in the mean over their noise: the posterior Cramér–Rao bound (Van Trees 1968; Tichavský, Muravchik and
// Nehorai 1998) of the motion that was really made.
//
// The model is the bench's own, linearised at the true motion: inertial samples with white noise of the simulated
// density and of rounding to counts; constant errors of bias, latency and lever arm with the spreads that the simulated
// calibration has; poses with the noise that the simulated tracker has at the true pose; the tip's place in the marker,
// which nothing in a recording shows, with its spread. Let x be the error of position, velocity, orientation (p, v, φ)
// and of these constants. Then with x' = Φ x + w, cov w = Q between poses and z = H x + n, cov n = R at poses, the
// Fisher information of all poses and samples is inverted by a filter forward and Rauch, Tung and Striebel's recursion
// backward,
//
//   P⁻ = Φ P Φᵀ + Q,  P = (P⁻¹ + Hᵀ R⁻¹ H)⁻¹,  Pˢ = P + C (Pˢ' − P⁻') Cᵀ,  C = P Φᵀ P⁻'⁻¹
//
// and the bound is √ mean tr(J Pˢ Jᵀ + R Σ_tip Rᵀ) over the poses, J the tip's derivative.
//
// Left out, which makes it lower, never higher: what the contact and the hand make likely or unlikely, the sensors'
// bandwidth, aliasing, clipping, scale errors, spikes, flips, jitter of clocks. Without a gyroscope the orientation's
// rate is taken as known. A biased estimate can have less error than the bound on a single recording.
double position_bound_m(const asperity::Recording& recording, const asperity::SimulationConfig& config);

}  // namespace bench
