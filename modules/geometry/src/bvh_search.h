#pragma once

#include "bvh_leaf.h"
#include "nearest_on_triangle.h"

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
    if (guess != kNone) {
      skip_ = guess;
      measure(guess);
    }
    if (size_ < kFar)
      descend();
    else
      descend_far();
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

  void descend() {
    alignas(32) float gap2[kWidth];
    std::uint64_t stack[kStackSize];
    int depth = 0;
    const V px = V::all(static_cast<float>(r_[0])), py = V::all(static_cast<float>(r_[1])),
            pz = V::all(static_cast<float>(r_[2]));
    std::uint32_t at = tree_.root;
    for (;;) {
      if (!(at & kLeafFlag)) {
        const Node& node = tree_.nodes[at];
        const V d2 = box_gap2<V>(node, px, py, pz);
        unsigned left = V::not_above(d2, V::all(reach2_));
        if (left != 0) {
          d2.store(gap2);
          int i = __builtin_ctz(left);
          left &= left - 1;
          if (left == 0) {
            at = node.child[i];
            continue;
          }
          // The nearest child next; the others wait, the nearer nearer the top.
          std::uint64_t nearest = key(gap2[i], node.child[i]);
          const int floor = depth;
          do {
            i = __builtin_ctz(left);
            left &= left - 1;
            std::uint64_t other = key(gap2[i], node.child[i]);
            if (other < nearest) {
              const std::uint64_t swap = other;
              other = nearest;
              nearest = swap;
            }
            int place = depth++;
            for (; place > floor && stack[place - 1] < other; --place) stack[place] = stack[place - 1];
            stack[place] = other;
          } while (left != 0);
          at = static_cast<std::uint32_t>(nearest);
          continue;
        }
      } else {
        visit_leaf(at);
      }
      for (;;) {
        if (depth == 0) return;
        const std::uint64_t top = stack[--depth];
        if (__builtin_bit_cast(float, static_cast<std::uint32_t>(top >> 32)) <= reach2_) {
          at = static_cast<std::uint32_t>(top);
          break;
        }
      }
    }
  }

  // Floats that are not negative are ordered as their bits.
  static std::uint64_t key(float gap2, std::uint32_t child) {
    return std::uint64_t{__builtin_bit_cast(std::uint32_t, gap2)} << 32 | child;
  }

  void visit_leaf(std::uint32_t at) {
    const LeafHead& head = leaf_head(tree_, at);
    LeafDistances<V> leaf;
    leaf.measure(head, r_);
    const float bound = leaf.no_less(head, leaf.nearest2);
    if (bound < bound_) tighten(bound);
    const float reach2 = leaf.reach2(head, bound_);
    if (leaf.nearest2 > reach2) return;
    for (unsigned left = leaf.not_above(head, reach2); left != 0; left &= left - 1) {
      const int i = __builtin_ctz(left);
      const std::uint32_t slot = head.first + static_cast<std::uint32_t>(i);
      if (slot != skip_) add({leaf.no_more(head, leaf.distance2[i]), slot});
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
    __builtin_prefetch(tree_.faces + candidate.slot);
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
        for (std::uint32_t i = 0; i < head.count; ++i)
          if (head.first + i != skip_) measure(head.first + i);
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
  std::uint32_t skip_ = kNone, best_triangle_ = kNone;
  Nearest best_;
  Candidate candidates_[kCandidates];
};

template <class V>
void closest(const TreeView& tree, const double* p, double radius, std::uint32_t guess, Nearest& out) {
  ClosestSearch<V>(tree, p, radius).run(guess, out);
}

}  // namespace asperity::bvh
