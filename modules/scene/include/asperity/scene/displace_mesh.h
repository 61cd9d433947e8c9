#pragma once

#include "asperity/geometry/mesh_file.h"
#include "asperity/scene/scene.h"

namespace asperity {

struct DisplaceMeshConfig {
  double spacing_mm = 0.2;
  double gain = 1.0;

  template <class V>
  void visit(V& v) {
    v.field("spacing_mm", spacing_mm, "textured triangles are cut until no edge is longer", {1e-3, 1e3});
    v.field("gain", gain, "heights are multiplied by it", {0.0, 1e3});
  }
};

// A mesh that carries its textures as real relief, to be printed: textured triangles are cut into a grid, whose points
// move out along the normal (angle-weighted, interpolated) by the texture's height, its lowest point on the surface
// (erratum 20). Towards triangles without texture the relief fades to nothing over the outermost textured ones, and
// where coordinates of two triangles disagree it takes their mean: no gap opens, a closed mesh stays closed. In the
// mesh's own unit. Textures that are not heights are left flat. Throws Error for more than 20 million triangles.
MeshFile displace_mesh(const SceneObject& object, const DisplaceMeshConfig& config = {});

}  // namespace asperity
