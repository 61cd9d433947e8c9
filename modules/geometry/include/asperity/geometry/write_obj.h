#pragma once

#include <filesystem>
#include <string>

#include "asperity/geometry/mesh_file.h"

namespace asperity {

// The mesh as a Wavefront OBJ: vertices, texture coordinates, normals, faces with their parts, then one
// `h` line a face if the mesh has haptic coordinates (thesis §6.3, Fig. 33). Every number is the shortest
// text that reads back as the same double, so parse_obj(format_obj(m)) has m's numbers bit for bit, and
// formatting that gives the same bytes. Names in no part, and what `materials` holds beside names, are
// not in an OBJ: see write_mtl.
// Throws Error for a mesh that contradicts itself (an index out of range, an attribute of another
// length, a number that is not finite) and for a name that an OBJ line cannot hold.
std::string format_obj(const MeshFile& mesh);

// format_obj into a file that is replaced as a whole.
void write_obj(const std::filesystem::path& path, const MeshFile& mesh);

}  // namespace asperity
