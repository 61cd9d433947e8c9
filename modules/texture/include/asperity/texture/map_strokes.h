#pragma once

#include <cstddef>
#include <limits>
#include <span>
#include <vector>

#include "asperity/base/problem.h"
#include "asperity/base/progress.h"
#include "asperity/texture/areal_spectrum.h"
#include "asperity/texture/areal_texture.h"

namespace asperity {

// A stroke over a plane: one entry a sample in every vector, in order, evenly spaced along the stroke.
struct AreaStroke {
  double spacing_m = 0.0;
  std::vector<double> x_m;
  std::vector<double> y_m;
  std::vector<double> height_m;  // nan: none
  double noise_m = 0.0;          // standard deviation of the texture's noise as the scan states it; 0: unknown
};

struct MapStrokesConfig {
  double spacing_mm = 0.0;
  double drift_mm = 10.0;
  double shift_mm = 0.0;
  double hole_share = 0.6;
  int held_out = 8;
  int most_points = 40000;

  template <class V>
  void visit(V& v) {
    v.field("spacing_mm", spacing_mm, "distance of the grid's points; 0: a third of the shortest wave with power",
            {0.0, 1e3});
    v.field("drift_mm", drift_mm, "a stroke's own error has waves longer than this, mm", {0.1, 1e4});
    v.field("shift_mm", shift_mm, "standard deviation of a stroke's position on the surface, mm; 0: exact",
            {0.0, 100.0});
    v.field("hole_share", hole_share,
            "the map has a hole where its standard deviation exceeds this share of the texture's RMS height",
            {0.01, 0.99});
    v.field("held_out", held_out, "strokes that are predicted from the others, one after another", {2, 1000});
    v.field("most_points", most_points, "of the grid", {1000, 1000000});
  }
};

// Strokes predicted from all others.
struct HeldOutStrokes {
  std::size_t strokes = 0;
  double samples = 0.0;  // where the map of the others claims heights
  double error_rms_m = std::numeric_limits<double>::quiet_NaN();
  double error_over_sigma = std::numeric_limits<double>::quiet_NaN();  // RMS; σ of the map and of a stroke together
  double explained = std::numeric_limits<double>::quiet_NaN();         // part of the held-out heights' variance
};

// A surface from many strokes; docs/areas-method.md has the mathematics.
struct StrokeMap {
  ArealTexture texture;  // sigma_m everywhere, supported 0 in holes
  ArealSpectrum spectrum;
  double rms_m = 0.0;           // of the surface, by its spectrum
  double disagreement_m = 0.0;  // standard deviation of one stroke's heights about the surface, its drift taken off
  double agreement = std::numeric_limits<double>::quiet_NaN();  // part of the strokes' variance that they share
  double agreement_sigma = std::numeric_limits<double>::quiet_NaN();
  std::size_t ties = 0;             // pairs of strokes that come near enough to be compared
  double correlation_mm = 0.0;      // length over which heights correlate by 1/e
  double sigma_rms_m = 0.0;         // over the map without its holes
  std::vector<double> drift_rms_m;  // [stroke]
  std::vector<double> shift_x_m;    // [stroke]: by which the stroke is displaced on the surface
  std::vector<double> shift_y_m;
  HeldOutStrokes held_out;
  Problems problems;  // "coarser_than_data"
};

// The height over the plane that explains the strokes best: a random surface with the spectrum that the strokes show
// along themselves (a Gaussian Markov random field on a grid of cubic B-splines), each stroke displaced by an offset
// and a drift of its own, and by a shift on the surface; strokes that cross or lie side by side determine them.
// `held_out` strokes are then predicted from the others. Without a tie between two strokes there is no map: `texture`
// stays empty and `agreement` nan. Throws Error for no stroke with 16 heights, and positions that are not finite.
StrokeMap map_strokes(std::span<const AreaStroke> strokes, const MapStrokesConfig& config = {},
                      const Observer& observer = {});

}  // namespace asperity
