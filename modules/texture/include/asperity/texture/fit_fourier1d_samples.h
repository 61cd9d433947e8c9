#pragma once

#include <span>

#include "asperity/base/problem.h"
#include "asperity/texture/fourier1d.h"

namespace asperity {

struct FitFourier1dSamplesConfig {
  int coefficients = 128;
  double ridge = 1e-4;
  int iterations = 300;

  template <class V>
  void visit(V& v) {
    v.field("coefficients", coefficients, "N, harmonics of the fundamental", {1, 8192});
    v.field("ridge", ridge, "weight of the coefficients' squares against the heights', which keeps gaps flat",
            {0.0, 1.0});
    v.field("iterations", iterations, "most conjugate-gradient steps", {1, 100000});
  }
};

struct FourierSamplesFit {
  Fourier1d texture;
  double rms_height_m = 0.0;       // of the samples about their mean
  double rms_error_m = 0.0;        // series against samples
  double relative_residual = 0.0;  // of the normal equations, where the iteration ended
  int iterations = 0;
};

// The series of period `length_m` through heights at any positions (not sorted, not even, with gaps) that
// minimises (1/M) Σ_i (g(x_i) − z_i)² + ridge · Σ_{j≠0} |c_j|², c_{±j} = (a_j ∓ i b_j)/2. Its normal matrix is
// Toeplitz, T_jk = (1/M) Σ_i exp(−i(j−k)ωx_i), so that a conjugate-gradient step costs two FFTs
// (Feichtinger, Gröchenig and Strohmer 1995). For M > 2N even samples over the period T is the identity and
// the result is the DFT's divided by 1 + ridge (erratum 18). Inside a gap longer than the finest wave the
// heights determine little: the ridge holds the series near its mean there. nan heights are left out. Throws
// Error for spans of unequal size, positions or heights that are not finite, fewer than 2N + 1 heights, or a
// length that is not positive.
FourierSamplesFit fit_fourier1d_samples(std::span<const double> x_m, std::span<const double> height_m, double length_m,
                                        const FitFourier1dSamplesConfig& config = {});

struct FitFourier1dPathConfig {
  double coefficients_per_mm = 12.8;
  int most_coefficients = 4096;
  double seam_mm = 2.5;
  double ridge = 1e-4;

  template <class V>
  void visit(V& v) {
    v.field("coefficients_per_mm", coefficients_per_mm,
            "harmonics per millimetre of path: frequency of the shortest wavelength", {1e-3, 1e3});
    v.field("most_coefficients", most_coefficients, "largest number of harmonics, for any length", {1, 8192});
    v.field("seam_mm", seam_mm, "length after the path's end, in which the series returns to its start", {0.0, 1e6});
    v.field("ridge", ridge, "weight of the coefficients' squares against the heights', which keeps gaps flat",
            {0.0, 1.0});
  }
};

// A whole path as one series: heights `spacing_m` apart, nan in gaps, x = 0 at the first. The period is the
// path and `seam_mm`; over it and over gaps the heights are bridged with their slopes, so that the series closes
// without bending the path and does not ring where nothing was measured. Problems: "coarse_texture" if the path has too
// few heights, or is too long, for coefficients_per_mm. Throws Error as above.
struct FourierPathFit {
  FourierSamplesFit fit;
  double height_offset_m = 0.0;
  Problems problems;
};
FourierPathFit fit_fourier1d_path(std::span<const double> height_m, double spacing_m,
                                  const FitFourier1dPathConfig& config = {});

}  // namespace asperity
