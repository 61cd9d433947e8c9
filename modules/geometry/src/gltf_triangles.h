#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "asperity/geometry/triangle_mesh.h"

namespace asperity {

// The triangles of a primitive of glTF whose vertices follow each other in `order`: lists, strips and fans. Throws
// Error naming `what` for a list whose length is no multiple of three.
std::vector<Triangle> gltf_triangles(int mode, std::span<const std::uint32_t> order, const std::string& what);

}  // namespace asperity
