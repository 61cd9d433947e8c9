#pragma once

#include <vector>

#include "asperity/base/progress.h"
#include "asperity/geometry/triangle_mesh.h"
#include "bvh_layout.h"

namespace asperity::bvh {

struct alignas(kPoolUnit) PoolUnit {
  unsigned char bytes[kPoolUnit];
};

struct TreeData {
  std::vector<Node> nodes;
  std::vector<PoolUnit> pool;
  std::vector<Face> faces;             // in the order of the leaves
  std::vector<double> vertices;        // those in use, in the order of their first use by a leaf
  std::vector<std::uint32_t> leaf_of;  // of each triangle, as Node::child
  double centre[3] = {};
  double to_mesh_units = 1.0, to_metres = 1.0;
  std::uint32_t root = kLeafFlag;
};

// The tree of a mesh: split top down by the surface area heuristic over bins (Wald 2007), where a leaf costs
// its blocks of eight triangles, up to eight parts at once. The same mesh gives the same tree. Throws Error for
// a mesh without triangles, an index out of range, a vertex that is not finite, or more than 2^30 vertices; Cancelled.
TreeData build_tree(const TriangleMesh& mesh, const Observer& observer = {});

}  // namespace asperity::bvh
