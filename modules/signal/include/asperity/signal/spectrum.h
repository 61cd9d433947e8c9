#pragma once

#include <complex>
#include <cstddef>
#include <span>
#include <vector>

namespace asperity {

// The discrete Fourier transform X_k = Σ x_m exp(-2πi k m / n), for k = 0 … n/2 (the rest is its
// conjugate). Any n, also prime, in O(n log n).
std::vector<std::complex<double>> real_dft(std::span<const double> x);

// The same of complex samples, for k = 0 … n − 1.
std::vector<std::complex<double>> complex_dft(std::span<const std::complex<double>> x);

// The n real samples whose real_dft is `half` (n/2 + 1 values). Throws Error if the size does not fit.
std::vector<double> inverse_real_dft(std::span<const std::complex<double>> half, std::size_t n);

// The smallest number from n on whose prime factors are 2, 3 and 5 only: such lengths are transformed fastest.
std::size_t smooth_length(std::size_t n);

struct PowerSpectrum {
  std::vector<double> frequency;  // cycles per unit of 1/rate, from 0 to rate/2
  std::vector<double> density;  // one-sided, unit of x² per unit of frequency: its sum times the step is the variance
  std::size_t segments = 0;     // averaged
};

// Welch's estimate (1967) with Hann windows that overlap by half, each segment's mean removed. A segment
// longer than x is shortened to it. Throws Error if it is shorter than 4 samples or rate not positive.
PowerSpectrum welch(std::span<const double> x, double rate, std::size_t segment_samples);

}  // namespace asperity
