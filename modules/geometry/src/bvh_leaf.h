#pragma once

#include <emmintrin.h>

#include "bvh_layout.h"

// Distances to the triangles of a leaf in float, to find those that may be nearest.
//
// In units of the leaf: rounding the corners moves a triangle by at most sqrt(3)/2 units; the bound
// is widened by 1. With R = |p - origin| + 65535 units, every distance^2 below is a polynomial evaluated at a
// point of the triangle whose terms sum to less than 9 R^2, so it is off by less than 2^-18 R^2. That the
// point is not quite the nearest one adds the square of its offset in the plane: the reciprocals (1.5/4096)
// and rounding along an edge give less than 2^-22 R^2. Inside a triangle of length l and width w rounding gives
// an offset below 2^-22 (l/w)^2 R, and taking the edges as well makes sure that it never counts for more than w;
// the leaf's slack is the largest min((2^-22 (l/w)^2)^2, (w/65535)^2) of its triangles, plus 2^-17.
namespace asperity::bvh {

// Lower bounds of the squared distances to eight triangles abc, up to the slack. With x = p - a, u = b - a,
// w = c - a all of them follow from the six products of these vectors.
template <class V>
[[gnu::always_inline]] inline V distances2(const LeafBlock& block, V px, V py, V pz) {
  const auto corner = [&](int v, int k) { return V::load(block.corner[v][k]); };
  const V ax = corner(0, 0), ay = corner(0, 1), az = corner(0, 2);
  const V ux = corner(1, 0) - ax, uy = corner(1, 1) - ay, uz = corner(1, 2) - az;
  const V wx = corner(2, 0) - ax, wy = corner(2, 1) - ay, wz = corner(2, 2) - az;
  const V xx = px - ax, xy = py - ay, xz = pz - az;
  const auto dot = [](V x1, V y1, V z1, V x2, V y2, V z2) {
    return V::multiply_add(x1, x2, V::multiply_add(y1, y2, z1 * z2));
  };
  const V pp = dot(xx, xy, xz, xx, xy, xz);
  const V pu = dot(xx, xy, xz, ux, uy, uz), pw = dot(xx, xy, xz, wx, wy, wz);
  const V uu = dot(ux, uy, uz, ux, uy, uz), ww = dot(wx, wy, wz, wx, wy, wz), uw = dot(ux, uy, uz, wx, wy, wz);
  const V zero = V::all(0.0f), one = V::all(1.0f);
  const V pu2 = pu + pu, pw2 = pw + pw;

  // |x - t e|^2 = x·x + t (t e·e - 2 x·e)
  const auto edge = [&](V from2, V along, V length2) {
    const V t = V::max(V::min(along * V::reciprocal(V::max(length2, one)), one), zero);
    return V::multiply_add(t, V::multiply_subtract(t, length2, along + along), from2);
  };
  const V opposite2 = uu + ww - (uw + uw);
  const V from_b2 = pp + (uu - pu2);
  const V along = (pw - pu) + (uu - uw);
  const V edges = V::min(V::min(edge(pp, pu, uu), edge(pp, pw, ww)), edge(from_b2, along, opposite2));

  const V inverse = V::reciprocal(V::max(V::multiply_subtract(uu, ww, uw * uw), one));
  const V s = V::multiply_subtract(ww, pu, uw * pw) * inverse;
  const V t = V::multiply_subtract(uu, pw, uw * pu) * inverse;
  const V inside = V::multiply_add(s, V::multiply_add(s, uu, V::multiply_subtract(t + t, uw, pu2)),
                                   V::multiply_add(t, V::multiply_subtract(t, ww, pw2), pp));
  return V::min(V::where_not_negative(s, t, one - (s + t), inside), edges);
}

inline constexpr float kCornerSlack = 1.0f;  // units of the leaf

// A point from the mesh's centre as the sum of two floats, 48 bits: its difference from an origin near it is exact
// to a rounding of the difference.
struct alignas(16) SplitPoint {
  float high[4], low[4];
};

[[gnu::always_inline]] inline SplitPoint split_point(const double* r) {
  // Whole registers: what is stored by parts and loaded as a whole stalls the processor.
  const __m128d xy = _mm_loadu_pd(r), z = _mm_load_sd(r + 2);
  const __m128 high_xy = _mm_cvtpd_ps(xy), high_z = _mm_cvtpd_ps(z);
  const __m128 low_xy = _mm_cvtpd_ps(_mm_sub_pd(xy, _mm_cvtps_pd(high_xy)));
  const __m128 low_z = _mm_cvtpd_ps(_mm_sub_pd(z, _mm_cvtps_pd(high_z)));
  SplitPoint out;
  _mm_store_ps(out.high, _mm_movelh_ps(high_xy, high_z));
  _mm_store_ps(out.low, _mm_movelh_ps(low_xy, low_z));
  return out;
}

// Of all triangles of a leaf.
template <class V>
class LeafDistances {
 public:
  [[gnu::always_inline]] LeafDistances(const LeafHead& head, const SplitPoint& r)
      : head_(head), per_unit_(__builtin_bit_cast(float, 0x7f000000u - __builtin_bit_cast(std::uint32_t, head.unit))) {
    V::spread(r.high, head.origin, r.low, per_unit_, x_, y_, z_);
    size_ = V::absolute(x_) + V::absolute(y_) + (V::absolute(z_) + V::all(65536.0f));
  }

  // Whether the leaf's turned box is within `bound`, mesh units. The place in it is off by less than 2^-20 R.
  [[gnu::always_inline]] bool may_be_within(float bound) const {
    const __m128 place = _mm_add_ps(_mm_mul_ps(x_.first_four(), _mm_load_ps(head_.axes[0])),
                                    _mm_add_ps(_mm_mul_ps(y_.first_four(), _mm_load_ps(head_.axes[1])),
                                               _mm_mul_ps(z_.first_four(), _mm_load_ps(head_.axes[2]))));
    const __m128 gap =
        _mm_max_ps(_mm_max_ps(_mm_sub_ps(_mm_load_ps(head_.low), place), _mm_sub_ps(place, _mm_load_ps(head_.high))),
                   _mm_setzero_ps());
    const __m128 square = _mm_mul_ps(gap, gap);
    const __m128 sum = _mm_add_ps(square, _mm_movehl_ps(square, square));
    const float gap2 = _mm_cvtss_f32(_mm_add_ss(sum, _mm_shuffle_ps(sum, sum, 1)));
    const float reach = bound * per_unit_ * (1.0f + 0x1p-20f) + size_.first() * 0x1p-19f;
    return gap2 <= reach * reach;
  }

  [[gnu::always_inline]] void measure() {
    const auto* const blocks = reinterpret_cast<const LeafBlock*>(&head_ + 1);
    slack2_ = V::all(head_.slack) * size_ * size_;
    distance2_[0] = distances2(blocks[0], x_, y_, z_);
    distance2_[1] = head_.count > kWidth ? distances2(blocks[1], x_, y_, z_) : V::all(__builtin_inff());
  }

  // Bit i: triangle i of the leaf may be within `bound`, mesh units.
  unsigned within(float bound) const {
    const V reach = V::all(bound * per_unit_ + kCornerSlack);
    const V reach2 = V::multiply_add(reach, reach, slack2_) * V::all(1.0f + 0x1p-20f);
    const unsigned bits = V::not_above(distance2_[0], reach2) | V::not_above(distance2_[1], reach2) << kWidth;
    return bits & ((1u << head_.count) - 1u);
  }

  // No less than the distance of the nearest, mesh units.
  float nearest_no_less() const {
    const float nearest2 = V::smallest(V::min(distance2_[0], distance2_[1]));
    return (__builtin_sqrtf(nearest2 + slack2_.first()) + kCornerSlack) * head_.unit * (1.0f + 0x1p-20f);
  }

  void store(float* distance2) const {
    for (int i = 0; i < kMaxBlocks; ++i) distance2_[i].store(distance2 + i * kWidth);
  }

  // No more than the distance whose square is stored, mesh units.
  float lower_bound_of(float distance2) const {
    const float low2 = distance2 - slack2_.first();
    return low2 > 0.0f ? (__builtin_sqrtf(low2) - kCornerSlack) * head_.unit * (1.0f - 0x1p-20f) : 0.0f;
  }

 private:
  const LeafHead& head_;
  float per_unit_;  // 1 / unit, a power of two
  V x_, y_, z_;     // of p, in units
  V size_, slack2_, distance2_[kMaxBlocks];
};

}  // namespace asperity::bvh
