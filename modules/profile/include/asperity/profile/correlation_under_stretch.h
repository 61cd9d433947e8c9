#pragma once

#include <span>

namespace asperity {

// The expected correlation of a texture with the true one where the length of its path has an error, and one shift
// aligns both.
//
// Let the length L have a relative error ε, normal with standard deviation σ. A point at s is stated at s + ε (s − m),
// m the middle of the path, where the best shift leaves no error. The standard deviation of its position is σ |s − m|.
// A texture of the one-sided density P(k) has the covariance ∫ P(k) cos(2πkδ) dk at the distance δ; the mean over a
// normal δ of standard deviation σ_s is ∫ P(k) exp(−(2πkσ_s)²/2) dk. The powers of both do not change, so the mean of
// the correlation over the path and over ε is
//
//   ρ = ∫ P(k) g(πkσL) dk / ∫ P(k) dk,    g(a) = ∫₀¹ exp(−a²u²/2) du = √(π/2) erf(a/√2)/a.
//
// Frequencies in cycles/mm, rising; the density in any unit. 1 where the density is 0 everywhere.
double correlation_under_stretch(std::span<const double> frequency_cycles_per_mm, std::span<const double> density,
                                 double length_sigma, double length_mm);

}  // namespace asperity
