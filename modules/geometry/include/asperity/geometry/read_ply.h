#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "asperity/base/progress.h"
#include "asperity/geometry/mesh_file.h"
#include "asperity/geometry/mesh_limits.h"

namespace asperity {

// Reads a PLY 1.0, ascii or binary of either byte order. Of `vertex`: x y z of any scalar type, and where
// they are nx ny nz, red green blue (whole numbers divided by their type's largest) and texture
// coordinates (u v, s t or texture_u texture_v), which all belong to vertices. Of `face`: the list
// vertex_indices or vertex_index of any types, polygons triangulated (see triangulate_polygon). Every
// other property and element is passed over and counted in `problems`, as are bytes after the last
// element, faces that use a vertex twice and faces of fewer than three corners, which are left out.
//
// Throws Error naming the file, and the line or the element and its place, for a header that is not a
// PLY's, a cut file, numbers that are not finite, indices out of range, faces that stand before the
// vertices, no vertices, or more than `limits`. `name` is what messages call the bytes.
MeshFile parse_ply(std::string_view bytes, const std::string& name, const MeshLimits& limits = {},
                   const Observer& observer = {});

MeshFile read_ply(const std::filesystem::path& path, const MeshLimits& limits = {}, const Observer& observer = {});

}  // namespace asperity
