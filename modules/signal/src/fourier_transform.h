#pragma once

#include <complex>
#include <cstddef>
#include <span>
#include <vector>

namespace asperity {

// How complex_dft() (spectrum.h) is done. Lengths of the factors 2, 3 and 5 by Stockham's self-sorting passes (Van Loan
// 1992, Computational Frameworks for the Fast Fourier Transform, §1.7): with N = r·m left to do and s transforms done,
//   y[q + s(r p + j)] = exp(−2πi j p / N) Σ_k exp(−2πi j k / r) x[q + s(p + m k)],   q < s, p < m, j < r.
// Others by Bluestein's convolution with a chirp (1970). A thread keeps the tables of the lengths that it used last, up
// to some 16 MB each of the two kinds.

// X_k for k = 0 … n/2 of n real samples, n even and positive: their pairs are the samples of a complex transform Z of
// half the length, which is E + iO of the even and odd samples' transforms; X_k = E_k + exp(−2πi k/n) O_k.
std::vector<std::complex<double>> even_real_dft(std::span<const double> x);

// The n samples of which `half` (n/2 + 1 values) is the even_real_dft.
std::vector<double> even_inverse_real_dft(std::span<const std::complex<double>> half);

}  // namespace asperity
