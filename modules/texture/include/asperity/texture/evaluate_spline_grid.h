#pragma once

#include "asperity/texture/height_and_gradient.h"
#include "asperity/texture/spline_grid.h"

namespace asperity {

// h and its gradient at (x_m, y_m): sixteen coefficients, whatever the grid's size. C¹ everywhere: at the
// border of a clamped or mirrored grid the position is slowed (turned) by a parabola over one spacing on
// either side, so that the slope dies out (changes sign) without a step. Does not allocate. Realtime-safe:
// yes, thread-safe: yes. nan for a position that is not finite or an empty grid.
HeightAndGradient evaluate_height(const SplineGrid& grid, double x_m, double y_m) noexcept;

// The lowest height, searched from the grid points that are low among their neighbours.
double lowest_height_m(const SplineGrid& grid);

}  // namespace asperity
