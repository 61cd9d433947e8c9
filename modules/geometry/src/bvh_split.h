#pragma once

#include <emmintrin.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <span>

#include "bvh_layout.h"

namespace asperity::bvh {

struct Box {
  __m128 low = _mm_set1_ps(std::numeric_limits<float>::infinity());
  __m128 high = _mm_set1_ps(-std::numeric_limits<float>::infinity());

  void add(const Box& other) {
    low = _mm_min_ps(low, other.low);
    high = _mm_max_ps(high, other.high);
  }
  void add(__m128 point) {
    low = _mm_min_ps(low, point);
    high = _mm_max_ps(high, point);
  }
  float half_area() const {
    alignas(16) float d[4];
    _mm_store_ps(d, _mm_sub_ps(high, low));
    return d[0] * d[1] + d[1] * d[2] + d[2] * d[0];
  }
};

inline __m128 twice_centre(const Box& box) { return _mm_add_ps(box.low, box.high); }

// Triangles first .. last of the order, their box and that of twice their middles.
struct Range {
  std::uint32_t first = 0, last = 0;
  Box box, middles;

  std::uint32_t count() const { return last - first; }
};

struct Split {
  int axis = -1;  // -1: none, the middles coincide
  int bin = 0;    // the last of the left
  float scale = 0.0f, low = 0.0f;
};

inline constexpr int kBins = 32;

inline int bin_of(float twice_centre, float low, float scale) {
  return std::clamp(static_cast<int>((twice_centre - low) * scale), 0, kBins - 1);
}

inline std::uint32_t blocks(std::uint32_t count) { return (count + kWidth - 1) / kWidth; }

// The split of the range between bins of the triangles' middles, on any axis, at which area times blocks is least.
// `boxes`: of all triangles in their present order.
Split best_split(const Range& range, std::span<const Box> boxes);

}  // namespace asperity::bvh
