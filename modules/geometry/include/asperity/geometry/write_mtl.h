#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "asperity/geometry/mesh_material.h"

namespace asperity {

// The materials as a Wavefront material library: newmtl, Kd, map_Kd, norm, bump, disp. A name that a
// material before it has gets a number (unique_material_names.h). parse_mtl reads it back the same. Throws Error for a
// name that a line cannot hold or a number that is not finite.
std::string format_mtl(std::span<const MeshMaterial> materials);

// format_mtl into a file that is replaced as a whole.
void write_mtl(const std::filesystem::path& path, std::span<const MeshMaterial> materials);

}  // namespace asperity
