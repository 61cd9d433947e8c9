#pragma once

#include <filesystem>
#include <string>

#include "asperity/geometry/mesh_file.h"

namespace asperity {

// The mesh as a binary STL: three float32 corners a triangle, each coordinate rounded to 24 bits (at most
// 6e-8 of its size), and the unit normal, zero for a triangle without area. Nothing else of the mesh is
// in it. Throws Error for a coordinate that is not finite or beyond float32, and an index out of range.
std::string format_stl(const MeshFile& mesh);

// format_stl into a file that is replaced as a whole.
void write_stl(const std::filesystem::path& path, const MeshFile& mesh);

}  // namespace asperity
