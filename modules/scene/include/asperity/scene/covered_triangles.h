#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "asperity/geometry/covered_triangle.h"

namespace asperity {

// CSV of the coordinates that lie below those of the mesh's `h` lines (ADR 15):
//   triangle,texture,x1_mm,y1_mm,x2_mm,y2_mm,x3_mm,y3_mm
// by rising triangle (from 0), within one from the lowest to the highest. Numbers read back exactly.
std::string format_covered_triangles(std::span<const CoveredTriangle> covered);

// Reads that for a mesh of `triangles` triangles. Throws Error naming file, line and column for a triangle out of range
// or out of order, a texture twice on one, a negative texture, or a number that is not finite.
std::vector<CoveredTriangle> parse_covered_triangles(std::string_view text, const std::string& name,
                                                     std::size_t triangles);

}  // namespace asperity
