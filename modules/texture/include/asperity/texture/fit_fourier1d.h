#pragma once

#include <cstddef>
#include <span>

#include "asperity/base/problem.h"
#include "asperity/base/progress.h"
#include "asperity/texture/fourier1d.h"

namespace asperity {

struct FitFourier1dConfig {
  double length_mm = 10.0;
  double shortest_mm = 2.5;
  int coefficients = 128;
  double seam_mm = 0.5;
  double max_gap_mm = 0.25;

  template <class V>
  void visit(V& v) {
    v.field("length_mm", length_mm, "sample length L of the texture", {1e-3, 1e6});
    v.field("shortest_mm", shortest_mm, "taken instead where no gap-free length L is found", {1e-3, 1e6});
    v.field("coefficients", coefficients, "N, harmonics of the fundamental", {1, 65536});
    v.field("seam_mm", seam_mm, "length over which the end is blended into the start; 0: not", {0.0, 1e6});
    v.field("max_gap_mm", max_gap_mm, "gaps up to this are bridged by a straight line", {0.0, 1e6});
  }
};

struct FourierFit {
  Fourier1d texture;
  std::size_t first_sample = 0;  // of the window that became the texture: x = 0 there
  std::size_t samples = 0;       // M
  std::size_t bridged = 0;       // of them, interpolated over gaps
  double rms_height_m = 0.0;     // of the window about its mean
  double rms_error_m = 0.0;      // model against the window, its seam included
  double height_offset_m = 0.0;  // erratum 20
  Problems problems;             // "short_texture"
};

// Fourier series of heights `spacing_m` apart, nan in gaps (thesis §6.5, erratum 18): of the M samples of
// a gap-free window of length L (the whole number of samples nearest to it), a_j = 2/M·Re and
// b_j = −2/M·Im of the discrete Fourier transform, j = 1…N. Of all windows, the one with the fewest
// bridged samples is taken; among those the one that continues itself best and whose RMS height is most
// like the whole profile's; among equals the first. The seam is closed by blending. Where no gap-free
// stretch is L long, the longest is taken whole, with N < M/2 and a Problem.
// Throws Error for an infinite height, a spacing that is not positive, M ≤ 2N at length L, or a profile
// without a gap-free stretch of `shortest_mm`.
FourierFit fit_fourier1d(std::span<const double> height_m, double spacing_m, const FitFourier1dConfig& config = {},
                         const Observer& observer = {});

}  // namespace asperity
