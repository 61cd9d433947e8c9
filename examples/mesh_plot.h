#pragma once

#include <string>

#include "asperity/geometry/mesh_path.h"
#include "asperity/scene/scene.h"

namespace asperity::examples {

// An SVG drawing, 900 by 460 px: the mesh seen along the mean normal of `path`, which runs from left to right, lit from
// above; on the textured triangles the texture's height in colours, and the path; beside it a part of that, larger.
// Facets that face away are left out, so an object with overhangs is not drawn right.
std::string mesh_svg(const SceneObject& object, const MeshPath& path);

}  // namespace asperity::examples
