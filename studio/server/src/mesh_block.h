#pragma once

#include <string_view>

#include "asperity/geometry/triangle_mesh.h"
#include "asperity/studio/block.h"

namespace asperity::studio {

// A mesh for the browser, in its own frame: "positions" [vertices, 3] in metres about the head's "origin_m" (float
// keeps a tenth of a micrometre of a metre so), "indices" [triangles, 3], "normals" [vertices, 3] unit, and "low_m",
// "high_m", the corners of its box. Throws Error for a mesh without triangles or a vertex that is not finite.
BlockWriter mesh_block(std::string_view kind, const TriangleMesh& mesh);

}  // namespace asperity::studio
