#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "asperity/base/areal_map.h"
#include "asperity/base/problem.h"

namespace asperity {

// Heights of an instrument's file, metres; nan where the instrument measured none.
struct SurfaceFile {
  ArealMap map;  // a profile is one row; its y_spacing_m is then 0
  std::string format;
  Problems problems;  // kind "checksum": a sum that the file states and its content does not have
  bool is_profile() const { return map.rows == 1; }
};

// Heights from a file of one of these formats, told apart by their first bytes; nullopt for anything else.
//   GSF     Gwyddion Simple Field 1.0 (Gwyddion user guide, "Gwyddion Simple Field")
//   SDF     ISO 25178-71, ASCII and binary (aISO-1.0, bISO-1.0, and their forerunners aBCR-1.0, bBCR-1.0)
//   SUR     Digital Surf, uncompressed
//   X3P     ISO 25178-72 (openGPS), binary or text data, with its mask of valid points
//   SMD     ISO 5436-2 softgauges: a profile of equal steps
// Missing points: nan in GSF and X3P, invalid points of X3P's mask, BAD in SDF's text, nan in its binary data, and the
// value below the lowest by two where a SUR marks special points; SMD has none. Of X3P the MD5 sums of main.xml and of
// the binary data are compared with those stated, of SMD the sum of its bytes; where none is stated none is missed.
// Throws Error naming `name`, the place and the value for a damaged file, a unit that is no length, a spacing that is
// not positive, heights of more than ten metres, and more than 2^27 heights.
std::optional<SurfaceFile> parse_surface_file(std::string_view bytes, const std::string& name);

}  // namespace asperity
