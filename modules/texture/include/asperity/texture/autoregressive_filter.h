#pragma once

#include <span>
#include <vector>

namespace asperity {

// The three forms of an all-pole filter 1/A(z), A(z) = 1 + Σ a_i z⁻ⁱ, of order 1 to 32:
// coefficients a_1…a_p; reflection coefficients k_1…k_p (Levinson), all within ±1 if and only if the filter is
// stable; and line spectral frequencies (Itakura 1975), the p angles 0 < ω_1 < … < ω_p < π at which
// A(z) ± z⁻⁽ᵖ⁺¹⁾ A(z⁻¹) vanishes. ω in rising order, ω_1 of the sum, is the same as stable: so a
// weighted mean of line spectral frequencies, weights positive, is stable too, and its narrowest gap, which bounds
// how sharp a resonance is, is no narrower than the narrowest of those it was mixed from.

// Fixed time, no allocation; `a` and `k` are as long as `lsf_rad`. Realtime-safe: yes.
void lsf_to_ar(std::span<const double> lsf_rad, std::span<double> a) noexcept;

// Levinson's recursion backwards. False, with what was found so far, if a |k| is not below 1: unstable.
bool ar_to_reflection(std::span<const double> a, std::span<double> k) noexcept;

void reflection_to_ar(std::span<const double> k, std::span<double> a) noexcept;

// The phase of the all-pass z⁻¹ z⁻ᵖA(z⁻¹)/A(z), computed unwrapped by its lattice, falls
// monotonically from 0 to −(p+1)π; the i-th frequency is where it is −iπ, found by bisection: none is missed, however
// close two lie. Throws Error for |k| >= 1 or an order out of range.
std::vector<double> reflection_to_lsf(std::span<const double> k);

// r_0…r_{count−1} of x = e/A(z), e white of variance `variance`.
std::vector<double> autocovariance(std::span<const double> k, double variance, int count);

// r_0…r_{count−1} over r_0, count being the length of `r`. Fixed time, no allocation. Realtime-safe: yes.
void autocorrelation(std::span<const double> k, std::span<double> r) noexcept;

// Reflection coefficients and the error's variance that reproduce r_0…r_p (Levinson 1947, Durbin 1960).
// Throws Error if r is not a positive definite sequence.
struct LevinsonResult {
  std::vector<double> k;
  double variance = 0.0;
};
LevinsonResult levinson(std::span<const double> r);

// variance |gain (1 + Σ b_i z⁻ⁱ)|² / |A(z)|² at z = e^(iω), the two-sided density a radian times 2π.
double power_density(std::span<const double> a, std::span<const double> b, double gain, double variance,
                     double omega_rad) noexcept;

}  // namespace asperity
