#pragma once

#include "asperity/geometry/mesh_bvh.h"
#include "bvh_build.h"

namespace asperity {

struct MeshBvh::Tree {
  bvh::TreeData data;
  bvh::TreeView view;
  const bvh::Kernels* kernels;
};

// The searches that this processor can run, the fastest last.
std::vector<const bvh::Kernels*> supported_kernels();

// Tests set the searches of a chosen instruction set.
struct MeshBvhAccess {
  static void use(MeshBvh& bvh, const bvh::Kernels& kernels) { bvh.tree_->kernels = &kernels; }
};

}  // namespace asperity
