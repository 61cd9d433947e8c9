#pragma once

#include <filesystem>

#include "asperity/base/progress.h"
#include "asperity/geometry/mesh_file.h"
#include "asperity/geometry/mesh_limits.h"

namespace asperity {

// Reads a mesh file by its extension: .obj (see read_obj), .ply, .stl, .off, .gltf, .glb, in any case of
// letters. Throws Error for another extension and as those readers do, and Cancelled.
MeshFile read_mesh(const std::filesystem::path& path, const MeshLimits& limits = {}, const Observer& observer = {});

}  // namespace asperity
