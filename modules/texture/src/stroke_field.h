#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "asperity/texture/areal_spectrum.h"
#include "stroke_samples.h"

namespace asperity {

// The points of a spline grid, in mm.
struct MapGrid {
  int columns = 0;
  int rows = 0;
  double spacing_mm = 0.0;
  double x_mm = 0.0;  // of the first point
  double y_mm = 0.0;

  Eigen::Index size() const { return static_cast<Eigen::Index>(columns) * rows; }
};

// What is known of surface and strokes before their samples.
struct FieldPrior {
  ArealSpectrum spectrum;
  double noise_m2 = 0.0;  // of a sample, white
  double drift_m = 0.0;   // standard deviation of a stroke's hats
  double offset_m = 0.0;  // of its offset
  double shift_mm = 0.0;  // of its shift along x and y; 0: none
};

// Surface and strokes as the samples show them.
struct StrokeField {
  MapGrid grid;
  Eigen::VectorXd coefficient_m;          // of the splines
  Eigen::VectorXd hat_m;                  // of all strokes, their offsets in it
  std::vector<Eigen::Vector2d> shift_mm;  // [stroke]: what is added to its positions
  std::vector<double> sigma_m;            // [grid point] of the height there; empty: not asked for

  // Height and gradient (m, m/mm) at a place that is inside the grid.
  Eigen::Vector3d at(double x_mm, double y_mm) const;
  // Of the nearest grid point.
  double sigma_at(double x_mm, double y_mm) const;
};

// The grid over all samples, `margin_mm` wider on each side.
MapGrid make_map_grid(const std::vector<StrokeSample>& samples, double spacing_mm, double margin_mm);

// The most likely surface, drifts and shifts; `steps` times, each shift's effect linear about the step before. Throws
// Error where the equations cannot be solved.
StrokeField solve_field(const MapGrid& grid, const std::vector<StrokeSample>& samples, const DriftBasis& basis,
                        const FieldPrior& prior, const std::vector<Eigen::Vector2d>& start_shift_mm, int steps,
                        bool with_sigma);

}  // namespace asperity
