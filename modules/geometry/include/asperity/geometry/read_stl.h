#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "asperity/base/progress.h"
#include "asperity/geometry/mesh_file.h"
#include "asperity/geometry/mesh_limits.h"

namespace asperity {

// Reads an STL, binary or ascii: binary if its size is that of its triangle count, whatever it begins
// with; ascii if it begins with "solid" and has no zero byte. Corners at the same coordinates become one
// vertex (-0 is 0), in the order of their first use; triangles without area are kept. The solids of an
// ascii file are objects. Facet normals follow from the corners and are not kept; those that point
// against them are counted in `problems`, as are the colours or attributes of a binary file and bytes
// after its last triangle. The 80 bytes of text before them are not kept.
//
// Throws Error naming the file, and the line or triangle, for a cut file, numbers that are not finite,
// statements that are not an STL's, no triangles, or more than `limits`. `name` is what messages call
// the bytes.
MeshFile parse_stl(std::string_view bytes, const std::string& name, const MeshLimits& limits = {},
                   const Observer& observer = {});

MeshFile read_stl(const std::filesystem::path& path, const MeshLimits& limits = {}, const Observer& observer = {});

}  // namespace asperity
