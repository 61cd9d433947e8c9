#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "asperity/geometry/mesh_path.h"
#include "asperity/geometry/mesh_surface.h"

namespace asperity {

struct SurfacePatchConfig {
  double reach_mm = 2.0;

  template <class V>
  void visit(V& v) {
    v.field("reach_mm", reach_mm, "of the patch beyond the strokes: triangles this near to one belong to it",
            {0.0, 1e3});
  }
};

// A part of a mesh that is a topological disc: one piece, one border, without holes.
struct SurfacePatch {
  TriangleMesh mesh;                     // the patch alone, its own numbering; metres, the mesh's frame
  std::vector<std::uint32_t> vertex;     // [patch vertex]: that of the mesh
  std::vector<std::uint32_t> triangle;   // [patch triangle]: that of the mesh, rising
  std::vector<std::uint32_t> border;     // patch vertices once round, the patch on their left seen from outside
  std::size_t filled = 0;                // triangles that no stroke reaches, enclosed by those that one does
  std::vector<std::size_t> paths_apart;  // paths on other parts of the mesh than the patch, rising
};

// The triangles within reach of the paths, over the surface's neighbours alone (the back of a thin plate is far away);
// of several pieces the one with most of the points, its enclosed gaps filled if together they are smaller than it, and
// closed where it meets itself in a single vertex. Throws Error if no path has a point, and where the patch is not a
// disc: it goes round the object or a hole of the mesh, or more than two triangles meet at an edge.
SurfacePatch find_surface_patch(const MeshSurface& surface, std::span<const MeshPath> paths,
                                const SurfacePatchConfig& config = {});

}  // namespace asperity
