#pragma once

#include <filesystem>
#include <string>

#include "asperity/geometry/mesh_file.h"

namespace asperity {

// The mesh as a binary little-endian PLY: vertices as doubles, exactly, their colours as doubles where
// every vertex has one, and the triangles. Texture and haptic coordinates, normals, parts and materials
// are not in it. Throws Error for a number that is not finite or an index out of range.
std::string format_ply(const MeshFile& mesh);

// format_ply into a file that is replaced as a whole.
void write_ply(const std::filesystem::path& path, const MeshFile& mesh);

}  // namespace asperity
