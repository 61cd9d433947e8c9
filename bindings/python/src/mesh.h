#pragma once

#include <utility>

#include "asperity/base/progress.h"
#include "asperity/geometry/mesh_bvh.h"
#include "asperity/geometry/triangle_mesh.h"

namespace asperity::python {

// A mesh of Python, with its tree; never changed.
struct Mesh {
  TriangleMesh mesh;
  MeshBvh bvh;

  // Throws Error as MeshBvh does.
  explicit Mesh(TriangleMesh of, const Observer& observer = {}) : mesh(std::move(of)), bvh(mesh, observer) {}
};

}  // namespace asperity::python
