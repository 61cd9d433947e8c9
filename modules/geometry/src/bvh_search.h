#pragma once

#include "asperity/geometry/nearest_on_triangle.h"
#include "bvh_leaf.h"

// The closest-point search over the tree, on eight floats at a time (V: Floats8Sse2 or Floats8Avx2).
//
// Floats only tell what cannot be nearest; everything that might be is measured in double. So the answer does
// not depend on the instruction set or on the order of the search, provided that no bound here is too tight:
//
// Boxes. Corners are rounded outwards. A float of p is off by at most 2^-24 |p|, each difference by 2^-24
// (|p| + 1), and the square root of the sum of squares by less than 2^-21 (|p| + 1). The bound is widened by
// twice that. Beyond kFar that would no longer cull, and boxes are measured in double.
namespace asperity::bvh {

constexpr double kFar = 4096.0;

// Functions that are no templates are always inlined, so that no instruction set's code is left for another's.
[[gnu::always_inline]] inline float box_margin(double size) { return static_cast<float>((size + 1.0) * 0x1p-20); }

// The bound that boxes within `bound` of p do not exceed; below infinity, so that empty boxes stay out.
[[gnu::always_inline]] inline float box_reach2(float bound, float margin) {
  const float reach = (bound + margin) * (1.0f + 0x1p-20f);
  return reach < 1e19f ? reach * reach : 3.0e38f;
}

[[gnu::always_inline]] inline float float_above(double x) {
  return x < 3.0e38 ? static_cast<float>(x) * (1.0f + 0x1p-22f) + 1e-37f : __builtin_inff();
}

// The squared distances from the boxes of a node.
template <class V>
V box_gap2(const Node& node, V px, V py, V pz) {
  const V zero = V::all(0.0f);
  const V dx = V::max(V::max(V::load(node.low[0]) - px, px - V::load(node.high[0])), zero);
  const V dy = V::max(V::max(V::load(node.low[1]) - py, py - V::load(node.high[1])), zero);
  const V dz = V::max(V::max(V::load(node.low[2]) - pz, pz - V::load(node.high[2])), zero);
  return V::multiply_add(dx, dx, V::multiply_add(dy, dy, dz * dz));
}

template <class V>
class ClosestSearch {
 public:
  // What run() writes before it reads is left as it is: clearing it would cost as much as a node.
  // cppcheck-suppress uninitMemberVar
  ClosestSearch(const TreeView& tree, const double* p, double radius) : tree_(tree), p_(p) {
    double sum = 0.0;
    for (int k = 0; k < 3; ++k) {
      r_[k] = p[k] - tree.centre[k];
      sum += r_[k] < 0.0 ? -r_[k] : r_[k];
    }
    size_ = sum;
    margin_ = box_margin(sum);
    tighten(float_above(radius));
  }

  void run(std::uint32_t guess, Nearest& out) {
    best_ = {__builtin_inf(), kNone, {0.0, 0.0, 0.0}};
    best_triangle_ = kNone;
    if (!(size_ < kFar)) {
      descend_far();
    } else {
      split_ = split_point(r_);
      px_ = V::all(split_.high[0]), py_ = V::all(split_.high[1]), pz_ = V::all(split_.high[2]);
      if (guess != kNone)
        search_from(guess);
      else
        search_from_root();
    }
    for (int i = 0; i < waiting_; ++i)
      if (candidates_[i].bound <= bound_) measure(candidates_[i].slot);
    out = best_;
  }

 private:
  struct Candidate {
    float bound;  // no more than its distance
    std::uint32_t slot;
  };
  static constexpr int kCandidates = 64;
  struct Pending {
    float gap2;
    std::uint32_t at;
  };
  // A node and the squared distances of its children that are not yet seen.
  struct alignas(32) Level {
    float keys[kWidth];
    const Node* node;
  };

  // Nothing farther than `bound` is of interest from here on.
  void tighten(float bound) {
    bound_ = bound;
    reach2_ = box_reach2(bound, margin_);
  }

  void measure(std::uint32_t slot) {
    const Face face = tree_.faces[slot];
    const auto near = nearest_on_triangle<V>(tree_.vertices + 3 * std::size_t{face.vertex0},
                                             tree_.vertices + 3 * std::size_t{face.vertex1},
                                             tree_.vertices + 3 * std::size_t{face.vertex2}, p_);
    if (near.distance2 > best_.distance2) return;
    if (near.distance2 == best_.distance2 && face.triangle >= best_triangle_) return;
    best_ = {near.distance2, slot, {near.weight[0], near.weight[1], near.weight[2]}};
    best_triangle_ = face.triangle;
    const float bound = float_above(__builtin_sqrt(near.distance2));
    if (bound < bound_) tighten(bound);
  }

  // Straight down to a leaf by the nearest child, then the other children on the way up.
  void search_from_root() {
    Level levels[kMaxDepth];
    int depth = 0;
    std::uint32_t at = tree_.root;
    while (!(at & kLeafFlag)) {
      const Node& node = tree_.nodes[at];
      const V keys = V::tagged(box_gap2<V>(node, px_, py_, pz_));
      const float nearest = V::smallest(keys);
      V::without(keys, nearest).store(levels[depth].keys);
      levels[depth++].node = &node;
      at = node.child[__builtin_bit_cast(std::uint32_t, nearest) % kWidth];
    }
    visit_leaf<false>(at);
    Pending pending[kStackSize];
    int count = 0;
    while (depth-- > 0) add_pending(V::load(levels[depth].keys), *levels[depth].node, 0, pending, count);
    descend_all(pending, count);
  }

  // What the leaf `at` holds, then the other children of the nodes on the way from it up to the root. All these
  // nodes are known beforehand, so the processor tests them side by side instead of one after the other.
  void search_from(std::uint32_t at) {
    visit_leaf<false>(at);
    Pending pending[kStackSize];
    int count = 0;
    for (std::uint32_t parent = leaf_head(tree_, at).parent; parent != kNone;) {
      const Node& node = tree_.nodes[parent / kWidth];
      add_pending(box_gap2<V>(node, px_, py_, pz_), node, 1u << parent % kWidth, pending, count);
      parent = node.parent;
    }
    descend_all(pending, count);
  }

  // The children within reach, but for those in `seen`.
  [[gnu::always_inline]] void add_pending(V gap2, const Node& node, unsigned seen, Pending* pending, int& count) const {
    unsigned left = V::not_above(gap2, V::all(reach2_)) & ~seen;
    if (left == 0) return;
    alignas(32) float gaps2[kWidth];
    gap2.store(gaps2);
    for (; left != 0; left &= left - 1) {
      const int i = __builtin_ctz(left);
      pending[count++] = {gaps2[i], node.child[i]};
      prefetch(node.child[i]);
    }
  }

  // What a visit reads first.
  void prefetch(std::uint32_t at) const {
    const char* const place = at & kLeafFlag ? reinterpret_cast<const char*>(&leaf_head(tree_, at))
                                             : reinterpret_cast<const char*>(tree_.nodes + at);
    for (int i = 0; i < 4; ++i) __builtin_prefetch(place + 64 * i);
  }

  void descend_all(const Pending* pending, int count) {
    for (int i = 0; i < count; ++i)
      if (pending[i].gap2 <= reach2_) descend(pending[i].at);
  }

  // The nearest child first. A node with more children to see waits as a level with the squared distances of
  // those; nothing is sorted, for most are out of reach by the time that the search comes back.
  void descend(std::uint32_t at) {
    Level levels[kMaxDepth];
    int depth = 0;
    if (at & kLeafFlag) return visit_leaf<true>(at);
    const Node* node = tree_.nodes + at;
    V keys = V::tagged(box_gap2<V>(*node, px_, py_, pz_));
    for (;;) {
      unsigned left = V::not_above(keys, V::all(reach2_));
      if (left != 0) {
        int i = __builtin_ctz(left);
        if ((left & (left - 1)) != 0) {
          const float nearest = V::smallest(keys);
          i = static_cast<int>(__builtin_bit_cast(std::uint32_t, nearest) % kWidth);
          V::without(keys, nearest).store(levels[depth].keys);
          levels[depth++].node = node;
        }
        const std::uint32_t child = node->child[i];
        if (!(child & kLeafFlag)) {
          node = tree_.nodes + child;
          keys = V::tagged(box_gap2<V>(*node, px_, py_, pz_));
          continue;
        }
        visit_leaf<true>(child);
      }
      if (depth == 0) return;
      --depth;
      node = levels[depth].node;
      keys = V::load(levels[depth].keys);
    }
  }

  template <bool TestBox>
  void visit_leaf(std::uint32_t at) {
    const LeafHead& head = leaf_head(tree_, at);
    LeafDistances<V> leaf(head, split_);
    if (TestBox && !leaf.may_be_within(bound_)) return;
    __builtin_prefetch(tree_.faces + head.first);
    __builtin_prefetch(tree_.faces + head.first + 4);
    __builtin_prefetch(tree_.faces + head.first + 8);
    leaf.measure();
    unsigned left = leaf.within(bound_);
    if (left == 0) return;
    const float bound = leaf.nearest_no_less();
    if (bound < bound_) {
      tighten(bound);
      left = leaf.within(bound_);
    }
    alignas(32) float distance2[kWidth * kMaxBlocks];
    leaf.store(distance2);
    for (; left != 0; left &= left - 1) {
      const int i = __builtin_ctz(left);
      add({leaf.lower_bound_of(distance2[i]), head.first + static_cast<std::uint32_t>(i)});
    }
  }

  void add(Candidate candidate) {
    if (waiting_ == kCandidates) {
      const int all = waiting_;
      waiting_ = 0;
      for (int i = 0; i < all; ++i)
        if (candidates_[i].bound <= bound_) measure(candidates_[i].slot);
    }
    candidates_[waiting_++] = candidate;
    const Face face = tree_.faces[candidate.slot];
    __builtin_prefetch(tree_.vertices + 3 * std::size_t{face.vertex0});
    __builtin_prefetch(tree_.vertices + 3 * std::size_t{face.vertex1});
    __builtin_prefetch(tree_.vertices + 3 * std::size_t{face.vertex2});
  }

  // As descend(), with boxes in double and every triangle of a leaf measured.
  void descend_far() {
    struct Entry {
      double gap2;
      std::uint32_t at;
    };
    Entry stack[kStackSize];
    int depth = 0;
    stack[depth++] = {0.0, tree_.root};
    while (depth > 0) {
      const Entry top = stack[--depth];
      if (!(top.gap2 <= limit2())) continue;
      if (top.at & kLeafFlag) {
        const LeafHead& head = leaf_head(tree_, top.at);
        for (std::uint32_t i = 0; i < head.count; ++i) measure(head.first + i);
        continue;
      }
      const Node& node = tree_.nodes[top.at];
      const int floor = depth;
      for (int i = 0; i < kWidth && node.child[i] != kNone; ++i) {
        double gap2 = 0.0;
        for (int k = 0; k < 3; ++k) {
          const double low = static_cast<double>(node.low[k][i]) - r_[k];
          const double high = r_[k] - static_cast<double>(node.high[k][i]);
          const double gap = low > high ? low : high;
          if (gap > 0.0) gap2 += gap * gap;
        }
        gap2 *= 1.0 - 0x1p-46;
        int place = depth++;
        for (; place > floor && stack[place - 1].gap2 < gap2; --place) stack[place] = stack[place - 1];
        stack[place] = {gap2, node.child[i]};
      }
    }
  }

  double limit2() const {
    const double bound = static_cast<double>(bound_);
    return best_.distance2 < bound * bound ? best_.distance2 : bound * bound;
  }

  const TreeView& tree_;
  const double* p_;
  double r_[3];  // p from the mesh's centre
  double size_;
  float margin_, bound_, reach2_;
  int waiting_ = 0;
  SplitPoint split_;
  V px_, py_, pz_;
  std::uint32_t best_triangle_ = kNone;
  Nearest best_;
  Candidate candidates_[kCandidates];
};

template <class V>
void closest(const TreeView& tree, const double* p, double radius, std::uint32_t guess, Nearest& out) {
  ClosestSearch<V>(tree, p, radius).run(guess, out);
}

}  // namespace asperity::bvh
