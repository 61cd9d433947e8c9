#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "asperity/base/progress.h"
#include "asperity/geometry/mesh_file.h"
#include "asperity/geometry/mesh_limits.h"

namespace asperity {

// Reads an OFF (Geomview's Object File Format) as text: OFF, and COFF with colours of vertices (0 to 1, or whole
// numbers 0 to 255 if one of them is above 1), or without the first word; then the numbers of vertices, faces and edges
// (which is not used), the vertices, and faces as "corners index index …". Polygons are triangulated. Colours of faces
// are counted in `problems`, as are triangles with the same vertex twice and polygons that cross themselves or have no
// area. Other kinds (NOFF, STOFF, 4OFF, nOFF, binary) are refused.
//
// Throws Error naming the file and line for a word that is not a finite number, an index out of range, a coordinate
// beyond 1e12, fewer lines than stated or more after them, no faces, or more than `limits`. `name` is what messages
// call the text.
MeshFile parse_off(std::string_view text, const std::string& name, const MeshLimits& limits = {},
                   const Observer& observer = {});

MeshFile read_off(const std::filesystem::path& path, const MeshLimits& limits = {}, const Observer& observer = {});

}  // namespace asperity
