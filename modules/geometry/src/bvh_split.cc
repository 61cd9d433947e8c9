#include "bvh_split.h"

#include <array>

namespace asperity::bvh {

Split best_split(const Range& range, std::span<const Box> boxes) {
  alignas(16) float low[4], size[4];
  _mm_store_ps(low, range.middles.low);
  _mm_store_ps(size, _mm_sub_ps(range.middles.high, range.middles.low));
  alignas(16) float scale[4] = {};
  for (int k = 0; k < 3; ++k) scale[k] = size[k] > 1e-30f ? kBins * (1.0f - 0x1p-20f) / size[k] : 0.0f;

  std::array<std::array<Box, kBins>, 3> box;
  std::array<std::array<std::uint32_t, kBins>, 3> count{};
  const __m128 low4 = range.middles.low, scale4 = _mm_load_ps(scale);
  for (std::uint32_t i = range.first; i < range.last; ++i) {
    alignas(16) std::int32_t bin[4];
    const __m128 place = _mm_mul_ps(_mm_sub_ps(twice_centre(boxes[i]), low4), scale4);
    _mm_store_si128(reinterpret_cast<__m128i*>(bin), _mm_cvttps_epi32(place));
    for (std::size_t k = 0; k < 3; ++k) {
      const auto b = static_cast<std::size_t>(std::min(bin[k], kBins - 1));
      box[k][b].add(boxes[i]);
      ++count[k][b];
    }
  }

  Split best;
  float best_cost = std::numeric_limits<float>::infinity();
  for (std::size_t k = 0; k < 3; ++k) {
    if (scale[k] == 0.0f) continue;
    std::array<float, kBins> right_cost{};
    Box right;
    std::uint32_t n = 0;
    for (std::size_t b = kBins - 1; b > 0; --b) {
      right.add(box[k][b]);
      n += count[k][b];
      right_cost[b] = n > 0 ? right.half_area() * static_cast<float>(blocks(n)) : -1.0f;
    }
    Box left;
    n = 0;
    for (std::size_t b = 0; b + 1 < kBins; ++b) {
      left.add(box[k][b]);
      n += count[k][b];
      if (n == 0 || right_cost[b + 1] < 0.0f) continue;
      const float cost = left.half_area() * static_cast<float>(blocks(n)) + right_cost[b + 1];
      if (cost < best_cost) {
        best_cost = cost;
        best = {static_cast<int>(k), static_cast<int>(b), scale[k], low[k]};
      }
    }
  }
  return best;
}

}  // namespace asperity::bvh
