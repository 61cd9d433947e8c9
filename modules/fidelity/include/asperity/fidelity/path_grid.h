#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "asperity/fidelity/stroke_signals.h"

namespace asperity {

// Evenly spaced points of a path: s = (first + i) · spacing_m.
struct PathGrid {
  std::ptrdiff_t first = 0;
  std::size_t count = 0;
  double spacing_m = 0.025e-3;

  double s_m(std::size_t i) const { return spacing_m * (static_cast<double>(first) + static_cast<double>(i)); }
};

// The grid of a profile.
PathGrid grid_of(const Profile& profile);

// A signal of the stroke on the grid (resample_over_path.h), of its usable samples; nan where there is none.
std::vector<double> over_path(const StrokeSignals& stroke, std::span<const double> signal, const PathGrid& grid);

// x(t) through a pole of `bandwidth_Hz`, at rising times, settled on the first value; 0: x itself.
std::vector<double> through_pole(std::span<const double> t_s, std::span<const double> x, double bandwidth_Hz);

// x at an index with a fraction: a cubic through four values, a straight line where one of the outer two is missing;
// nan outside, and beside a nan.
double value_at(std::span<const double> x, double place);

}  // namespace asperity
