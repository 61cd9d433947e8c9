#pragma once

#include <cstddef>
#include <span>

#include "asperity/base/problem.h"
#include "asperity/base/progress.h"
#include "asperity/texture/areal_texture.h"

namespace asperity {

// A measured height over the plane: x along, y across, as the strokes or the map have them.
struct ArealSample {
  double x_m = 0.0;
  double y_m = 0.0;
  double height_m = 0.0;
};

struct FitArealConfig {
  double spacing_mm = 0.0;
  double smoothness = 1e-3;
  Border border = Border::kMirror;
  double period_x_mm = 0.0;
  double period_y_mm = 0.0;
  int iterations = 200;

  template <class V>
  void visit(V& v) {
    v.field("spacing_mm", spacing_mm,
            "distance of the grid's points; 0: the data's, at most 0.1 mm if they are not a grid", {0.0, 1e6});
    v.field("smoothness", smoothness, "weight of curvature against heights, a grid point with one sample each",
            {1e-9, 1e6});
    v.choice("border", border, kBorderNames, "beyond the measured area");
    v.field("period_x_mm", period_x_mm, "border periodic: what repeats along x; 0: the samples' extent", {0.0, 1e6});
    v.field("period_y_mm", period_y_mm, "border periodic: what repeats along y; 0: the samples' extent", {0.0, 1e6});
    v.field("iterations", iterations, "most conjugate-gradient steps a level", {1, 100000});
  }
};

struct ArealFit {
  ArealTexture texture;
  double rms_height_m = 0.0;       // of the samples about their mean
  double rms_error_m = 0.0;        // surface against samples
  double supported_part = 0.0;     // of the grid's points
  double relative_residual = 0.0;  // of the normal equations, where the last level's iteration ended
  double height_offset_m = 0.0;
  Problems problems;  // "areal_gaps", "missing_heights", "not_converged", "coarser_than_data"
};

// A smooth surface through scattered heights, as of many strokes: the cubic B-spline grid c that minimises
//   Σ_i (h(x_i, y_i) − z_i)² + λ Σ (c_uu² + 2 c_uv² + c_vv²)
// where c_uu, c_uv and c_vv are second differences over the grid (a thin plate's energy; Duchon 1977, on a
// grid as Eilers and Marx 1996), λ = smoothness · max(1, samples a grid point). Gaps are filled as a thin
// plate would and marked in `supported`. Solved by conjugate gradients from coarse to fine grids (each
// coarse solution is the finer one's start), always with the same bits. nan heights are left out. The grid's points
// are by default as far apart as the samples: an areal map's own spacing (the smaller of its two, which differ by a
// factor of 3 at most); for other samples √(area / samples), at most 0.1 mm; coarser, with the Problem
// "coarser_than_data", where that would be more than 1,048,576 points or 2048 a side. Throws Error for fewer than 16
// samples, positions that are not finite or on one line, an infinite height, or a grid of more than 4096 points a side
// or 4,194,304 in all; Cancelled.
ArealFit fit_areal(std::span<const ArealSample> samples, const FitArealConfig& config = {},
                   const Observer& observer = {});

}  // namespace asperity
