#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "asperity/base/problem.h"
#include "asperity/geometry/mesh_material.h"

namespace asperity {

struct MaterialLibrary {
  std::vector<MeshMaterial> materials;
  Problems problems;
};

// Reads a Wavefront material library (MTL): newmtl, Kd, map_Kd, norm, bump (map_bump) and disp. Options
// of textures and all other statements are counted in `problems`, as are damaged lines: a material
// carries no geometry, so nothing in it is a reason to refuse a mesh. A texture's file name that leads
// out of the library's folder is left empty and is a problem.
// Throws Error for UTF-16, binary bytes and lines of more than 64 KiB. `name` is what messages call the text.
MaterialLibrary parse_mtl(std::string_view text, const std::string& name);

}  // namespace asperity
