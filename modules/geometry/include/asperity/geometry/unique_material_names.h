#pragma once

#include <span>
#include <string>
#include <vector>

#include "asperity/geometry/mesh_material.h"

namespace asperity {

// The materials' names, of which an OBJ's usemtl and its MTL need each once: the second of a name becomes name_2, the
// third name_3, passing over names that are taken. Empty names stay empty.
std::vector<std::string> unique_material_names(std::span<const MeshMaterial> materials);

}  // namespace asperity
