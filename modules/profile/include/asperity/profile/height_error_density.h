#pragma once

#include "asperity/profile/texture_noise.h"

namespace asperity {

// The one-sided density of a smoothed height's error at a time frequency, m²/Hz (docs/texture-noise.md). The error of
// the acceleration has the density A(f) = A (1 + f_1/f) + walk/(2πf)² + F² S_θ(f): white, 1/f, a walk of the offset,
// and the specific force F across the normal that a wrong orientation turns into it. With the tracker's white error R
// and its slow one S_s(f) = 4 σ² τ/(1 + (2πfτ)²), and its share W = A(f)/(A(f) + R (2πf)⁴) in the height, it is
//
//   W R + W² S_s + (1 − W)² C(f) + l² S_θ(f) + σ_φ² S_w(f),
//
// σ_φ² S_w what the sway across the path leaves in the height, the normals' lean being known to σ_φ; C what calibration
// errors carry from the motion into the height, l the lever from the sensor to the tip. The orientation's own error is
// that of the tracker's and the gyroscope's best, S_θ = G R_θ/(G + R_θ (2πf)²), or without a gyroscope B R_θ/(B + R_θ
// (2πf)⁴). An object that moves adds, for each axis of its motion (ObjectAxisError), weight·(W' N + W'² S_s) with W' =
// Q/(Q + N (2πf)⁴), N and Q the densities of its poses and of its acceleration. 0 where A or R is not known.
double height_error_density_m2ps(const HeightErrors& errors, double frequency_Hz);

}  // namespace asperity
