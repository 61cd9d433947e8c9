#pragma once

#include "bvh_leaf.h"
#include "bvh_search.h"

namespace asperity::bvh {

// The triangles within the radius of p, culled as by ClosestSearch and each measured in double.
template <class V>
std::size_t within(const TreeView& tree, const double* p, double radius, std::uint32_t* out, std::size_t room) {
  std::size_t found = 0;
  const auto measure = [&](std::uint32_t slot) {
    const Face face = tree.faces[slot];
    const auto near = nearest_on_triangle<V>(tree.vertices + 3 * std::size_t{face.vertex0},
                                             tree.vertices + 3 * std::size_t{face.vertex1},
                                             tree.vertices + 3 * std::size_t{face.vertex2}, p);
    if (__builtin_sqrt(near.distance2) > radius) return;
    if (found < room) out[found] = face.triangle;
    ++found;
  };
  double r[3], size = 0.0;
  for (int k = 0; k < 3; ++k) {
    r[k] = p[k] - tree.centre[k];
    size += __builtin_fabs(r[k]);
  }
  if (!(size < kFar)) {
    // Farther than a few sizes of the mesh, the radius holds nothing of it or must be immense.
    if (radius > 0.5 * size)
      for (std::uint32_t i = 0; i < tree.face_count; ++i) measure(i);
    return found;
  }

  const float bound = float_above(radius);
  const V reach2 = V::all(box_reach2(bound, box_margin(size)));
  const SplitPoint split = split_point(r);
  const V px = V::all(split.high[0]), py = V::all(split.high[1]), pz = V::all(split.high[2]);
  std::uint32_t stack[kStackSize];
  int depth = 0;
  stack[depth++] = tree.root;
  while (depth > 0) {
    const std::uint32_t at = stack[--depth];
    if (at & kLeafFlag) {
      const LeafHead& head = leaf_head(tree, at);
      LeafDistances<V> leaf(head, split);
      if (!leaf.may_be_within(bound)) continue;
      leaf.measure();
      for (unsigned left = leaf.within(bound); left != 0; left &= left - 1)
        measure(head.first + static_cast<std::uint32_t>(__builtin_ctz(left)));
      continue;
    }
    const Node& node = tree.nodes[at];
    for (unsigned left = V::not_above(box_gap2<V>(node, px, py, pz), reach2); left != 0; left &= left - 1)
      stack[depth++] = node.child[__builtin_ctz(left)];
  }
  return found;
}

}  // namespace asperity::bvh
