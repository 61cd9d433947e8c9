#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "asperity/texture/map_strokes.h"

namespace asperity {

// A sample for the map: the mean of a stroke's heights over a step. Lengths in mm, heights in m.
struct StrokeSample {
  double x_mm = 0.0;
  double y_mm = 0.0;
  double height_m = 0.0;
  double s_mm = 0.0;         // along the stroke
  double texture_m = 0.0;    // height less the stroke's own smooth course
  std::uint32_t stroke = 0;  // its index
};

// The smooth courses of the strokes: hats over s, knots half of the longest texture wave apart.
struct DriftBasis {
  double knot_mm = 5.0;
  std::vector<std::uint32_t> first;  // [stroke]: its first hat; one more at the end

  std::size_t size() const { return first.back(); }
};

// The samples `step_mm` apart, by stroke and s. A step with less than half of its heights has none.
std::vector<StrokeSample> thin_strokes(std::span<const AreaStroke> strokes, double step_mm);

DriftBasis make_drift_basis(std::span<const AreaStroke> strokes, double drift_mm);

// Fills `texture_m`: heights less the hats that fit them best, stroke by stroke. Returns the standard deviation of the
// hats' coefficients about their stroke's mean.
double detrend(std::vector<StrokeSample>& samples, const DriftBasis& basis);

// The strokes' mean density along themselves, one-sided, m² mm, over cycles/mm from twice 1/drift_mm to the frequency
// below which they have `part` of their power there. Empty if no stroke has a gap-free run of `drift_mm`.
struct StrokeSpectrum {
  std::vector<double> frequency_cycles_per_mm;
  std::vector<double> density_m2mm;
};
StrokeSpectrum measure_strokes(std::span<const AreaStroke> strokes, double drift_mm, double part);

// How many pairs of strokes come nearer to each other than `reach_mm`.
std::size_t count_ties(const std::vector<StrokeSample>& samples, double reach_mm);

}  // namespace asperity
