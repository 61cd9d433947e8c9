#pragma once

#include "bvh_layout.h"

namespace asperity::bvh {

// The first hit of a ray, after Woop, Benthin and Wald (2013), in double: the corners are sheared so that the ray
// runs along an axis, and the signs of the areas that it makes with the edges tell whether it passes inside.
// Triangles that share an edge compute its area from the same two products, so their signs are opposite and
// a ray through an edge or a corner hits one of them. An edge-on triangle is not hit.
//
// Boxes are tested in float. The origin is first moved along the ray to the mesh, so that float coordinates
// stay below 4; boxes are widened by 2^-17, more than the rounding of the origin, of t and of the box
// (and by 2^-48 of the way to the mesh, where that is long).
template <class V>
class RaySearch {
 public:
  RaySearch(const TreeView& tree, const double* origin, const double* direction, double t_max, Hit& out)
      : tree_(tree), origin_(origin), direction_(direction), hit_(out) {
    hit_ = {t_max, kNone, {0.0, 0.0, 0.0}};
    for (int k = 1; k < 3; ++k)
      if (__builtin_fabs(direction[k]) > __builtin_fabs(direction[z_])) z_ = k;
  }

  void run() {
    double enter = 0.0, leave = hit_.t;
    for (int k = 0; k < 3; ++k) {
      const double r = origin_[k] - tree_.centre[k];
      if (direction_[k] == 0.0) {
        if (__builtin_fabs(r) > kReach) return;
        continue;
      }
      const double t0 = (-kReach - r) / direction_[k], t1 = (kReach - r) / direction_[k];
      enter = t0 < t1 ? (t0 > enter ? t0 : enter) : (t1 > enter ? t1 : enter);
      leave = t0 < t1 ? (t1 < leave ? t1 : leave) : (t0 < leave ? t0 : leave);
    }
    if (!(enter <= leave)) return;
    start_ = enter;
    descend();
  }

 private:
  static constexpr double kReach = 2.0;  // the mesh lies within 1 of its centre

  float limit() const {
    const double left = hit_.t - start_;
    return left < 1e30 ? static_cast<float>(left) * (1.0f + 0x1p-20f) + static_cast<float>(0x1p-17 + 0x1p-48 * start_)
                       : 1e30f;
  }

  void descend() {
    const float slack = static_cast<float>(0x1p-17 + 0x1p-48 * start_);
    V low_origin[3], high_origin[3], inverse[3];
    for (int k = 0; k < 3; ++k) {
      const float o = static_cast<float>(origin_[k] - tree_.centre[k] + start_ * direction_[k]);
      low_origin[k] = V::all(o + slack);
      high_origin[k] = V::all(o - slack);
      // A component below 2^-60 moves the ray by nothing that counts.
      float d = static_cast<float>(direction_[k]);
      if (!(__builtin_fabsf(d) > 0x1p-60f)) d = 0x1p-60f;
      inverse[k] = V::all(1.0f / d);
    }
    alignas(32) float enters[kWidth];
    std::uint64_t stack[kStackSize];
    int depth = 0;
    stack[depth++] = tree_.root;
    while (depth > 0) {
      const std::uint64_t top = stack[--depth];
      if (__builtin_bit_cast(float, static_cast<std::uint32_t>(top >> 32)) > limit()) continue;
      const auto at = static_cast<std::uint32_t>(top);
      if (at & kLeafFlag) {
        const LeafHead& head = leaf_head(tree_, at);
        for (std::uint32_t i = 0; i < head.count; ++i) test(head.first + i);
        continue;
      }
      const Node& node = tree_.nodes[at];
      V enter = V::all(0.0f), leave = V::all(limit());
      for (int k = 0; k < 3; ++k) {
        const V t0 = (V::load(node.low[k]) - low_origin[k]) * inverse[k];
        const V t1 = (V::load(node.high[k]) - high_origin[k]) * inverse[k];
        enter = V::max(V::min(t0, t1), enter);
        leave = V::min(V::max(t0, t1), leave);
      }
      unsigned left = V::not_above(enter, leave * V::all(1.0f + 0x1p-18f));
      enter.store(enters);
      const int floor = depth;
      for (; left != 0; left &= left - 1) {
        const int i = __builtin_ctz(left);
        if (node.child[i] == kNone) continue;
        const std::uint64_t key = std::uint64_t{__builtin_bit_cast(std::uint32_t, enters[i])} << 32 | node.child[i];
        int place = depth++;
        for (; place > floor && stack[place - 1] < key; --place) stack[place] = stack[place - 1];
        stack[place] = key;
      }
    }
  }

  void test(std::uint32_t slot) {
    const Face face = tree_.faces[slot];
    const double* const corner[3] = {tree_.vertices + 3 * std::size_t{face.vertex0},
                                     tree_.vertices + 3 * std::size_t{face.vertex1},
                                     tree_.vertices + 3 * std::size_t{face.vertex2}};
    const int x_axis = z_ == 2 ? 0 : z_ + 1, y_axis = z_ == 0 ? 2 : z_ - 1;
    double x[3], y[3], z[3];
    for (int v = 0; v < 3; ++v) {
      z[v] = (corner[v][z_] - origin_[z_]) / direction_[z_];
      x[v] = (corner[v][x_axis] - origin_[x_axis]) - direction_[x_axis] * z[v];
      y[v] = (corner[v][y_axis] - origin_[y_axis]) - direction_[y_axis] * z[v];
    }
    const double w0 = x[2] * y[1] - y[2] * x[1];
    const double w1 = x[0] * y[2] - y[0] * x[2];
    const double w2 = x[1] * y[0] - y[1] * x[0];
    if ((w0 < 0.0 || w1 < 0.0 || w2 < 0.0) && (w0 > 0.0 || w1 > 0.0 || w2 > 0.0)) return;
    const double sum = w0 + w1 + w2;
    if (sum == 0.0) return;
    const double t = (w0 * z[0] + w1 * z[1] + w2 * z[2]) / sum;
    if (!(t >= 0.0 && t <= hit_.t)) return;
    if (hit_.slot != kNone && t == hit_.t && face.triangle >= tree_.faces[hit_.slot].triangle) return;
    hit_ = {t, slot, {w0 / sum, w1 / sum, w2 / sum}};
  }

  const TreeView& tree_;
  const double* origin_;
  const double* direction_;
  Hit& hit_;
  int z_ = 0;  // the direction's largest component
  double start_ = 0.0;
};

template <class V>
void cast_ray(const TreeView& tree, const double* origin, const double* direction, double t_max, Hit& out) {
  RaySearch<V>(tree, origin, direction, t_max, out).run();
}

}  // namespace asperity::bvh
