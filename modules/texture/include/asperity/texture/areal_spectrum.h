#pragma once

#include <span>

namespace asperity {

// A power spectrum over two dimensions without a direction,
//   P(k) = A / (k⁴ + 2 t κ² k² + κ⁴),   t > −1,
// k in rad/mm: flat below κ for t near 1 (Matérn's with ν = 1; Whittle 1954), with a ring of power near κ for t < 0
// (Lindgren, Rue and Lindström 2011, §3.3). Lengths in mm, heights in m.
struct ArealSpectrum {
  double A = 1.0;  // m²/mm²
  double kappa_per_mm = 1.0;
  double t = 1.0;

  double variance_m2() const;
  // Two-sided density of a straight section over q in rad/mm: variance = ∫ dq / 2π.
  double section_m2mm(double q_per_mm) const;
  double covariance_m2(double distance_mm) const;
  // The least distance at which the correlation is `correlation`.
  double distance_mm(double correlation) const;
  // ∫ ρ(s)² ds along a section: how far apart two independent heights are.
  double independent_mm() const;
  // The frequency below which a section has this part of its power.
  double frequency_cycles_per_mm(double part) const;
};

// The spectrum whose section is likeliest for the density `density_m2mm` (one-sided, over cycles/mm) at the
// frequencies, by Whittle's likelihood (1953): Σ log S + I/S least, by a search over t and κ. Frequencies rise.
ArealSpectrum fit_areal_spectrum(std::span<const double> frequency_cycles_per_mm, std::span<const double> density_m2mm);

}  // namespace asperity
