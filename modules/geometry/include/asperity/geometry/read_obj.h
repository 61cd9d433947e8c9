#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "asperity/base/progress.h"
#include "asperity/geometry/mesh_file.h"
#include "asperity/geometry/mesh_limits.h"

namespace asperity {

// Reads a Wavefront OBJ, plain or augmented by haptic coordinates (thesis §6.3, Fig. 33, erratum 22):
// after the faces one line a face, in their order, `h INDEX x1 y1 x2 y2 x3 y3` in millimetres.
// Numbers are kept exactly. Polygons are triangulated (see triangulate_polygon); a file with `h` lines
// may hold triangles only. An index below zero counts back from what was read so far; what a face
// names must be defined before it.
//
// Throws Error "file:line: message" for text that is not an OBJ: a missing, surplus, misspelt or non-finite
// number, an index that is zero or out of range, a face with fewer than three corners or with texture
// or normal indices at some corners only, misplaced or miscounted `h` lines, UTF-16, no vertices, more
// than `limits`. Well-formed data that a MeshFile cannot hold (points, lines, free-form curves,
// unknown statements) is counted in `problems`, one entry a kind with the line of the first; so are
// faces that use a vertex twice, and those whose outline crosses itself: they are kept.
//
// parse_obj leaves material libraries unread: `materials` holds the names only. `name` is what messages
// call the text.
MeshFile parse_obj(std::string_view text, const std::string& name, const MeshLimits& limits = {},
                   const Observer& observer = {});

// parse_obj of a file, and its material libraries from the same folder or below. One that is missing,
// lies elsewhere or cannot be read is a problem.
MeshFile read_obj(const std::filesystem::path& path, const MeshLimits& limits = {}, const Observer& observer = {});

}  // namespace asperity
