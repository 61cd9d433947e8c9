#pragma once

#include <string>

#include "asperity/base/areal_map.h"

namespace asperity {

// Heights as files of surface instruments, as parse_surface_file() reads them again: a map, or a profile (one row,
// whose y_spacing_m has no meaning). Missing heights (nan) are marked. The same heights give the same bytes; files have
// no dates. Each throws Error for a map without heights, of more than 2^27 or of another number than columns · rows, an
// infinite height and a spacing that is not positive.

// Gwyddion Simple Field 1.0: 32-bit numbers in metres, nan where missing.
std::string format_gsf(const ArealMap& map);

enum class SdfForm { kText, kBinary };

// ISO 25178-71: aISO-1.0, numbers as text, BAD where missing; or bISO-1.0, doubles, nan where missing. Both
// in metres (Zscale 1) with all of their digits. The binary form has at most 65,535 points a row and rows: Error
// beyond.
std::string format_sdf(const ArealMap& map, SdfForm form);

}  // namespace asperity
