#pragma once

#include <span>
#include <vector>

#include "asperity/plot/drawing.h"

namespace asperity {

// Points in the order of the line, already in px: of each run within a half pixel column the first, lowest, highest and
// last (the M4 aggregation of U. Jugel et al., PVLDB 7, 2014). The stroke covers the same pixels, to half of one.
std::vector<DrawingPoint> thin_curve(std::span<const DrawingPoint> points);

}  // namespace asperity
