#pragma once

#include <emmintrin.h>

#include <cstdint>

namespace asperity::bvh {

// Eight floats as two registers of SSE2, which every x86-64 has. Same interface as Floats8Avx2.
struct Floats8Sse2 {
  __m128 lower, upper;

  static constexpr float kNothing = 3.3e38f;

  static Floats8Sse2 all(float x) { return {_mm_set1_ps(x), _mm_set1_ps(x)}; }
  static Floats8Sse2 load(const float* x) { return {_mm_load_ps(x), _mm_load_ps(x + 4)}; }
  static Floats8Sse2 load(const std::uint16_t* x) {
    const __m128i whole = _mm_load_si128(reinterpret_cast<const __m128i*>(x));
    const __m128i zero = _mm_setzero_si128();
    return {_mm_cvtepi32_ps(_mm_unpacklo_epi16(whole, zero)), _mm_cvtepi32_ps(_mm_unpackhi_epi16(whole, zero))};
  }
  // (a - b) + c of three components, scaled and each in all places.
  static void spread(const float* a, const float* b, const float* c, float scale, Floats8Sse2& x, Floats8Sse2& y,
                     Floats8Sse2& z) {
    const __m128 q =
        _mm_mul_ps(_mm_add_ps(_mm_sub_ps(_mm_load_ps(a), _mm_load_ps(b)), _mm_load_ps(c)), _mm_set1_ps(scale));
    x.lower = x.upper = _mm_shuffle_ps(q, q, 0x00);
    y.lower = y.upper = _mm_shuffle_ps(q, q, 0x55);
    z.lower = z.upper = _mm_shuffle_ps(q, q, 0xaa);
  }
  void store(float* x) const {
    _mm_store_ps(x, lower);
    _mm_store_ps(x + 4, upper);
  }

  friend Floats8Sse2 operator+(Floats8Sse2 a, Floats8Sse2 b) {
    return {_mm_add_ps(a.lower, b.lower), _mm_add_ps(a.upper, b.upper)};
  }
  friend Floats8Sse2 operator-(Floats8Sse2 a, Floats8Sse2 b) {
    return {_mm_sub_ps(a.lower, b.lower), _mm_sub_ps(a.upper, b.upper)};
  }
  friend Floats8Sse2 operator*(Floats8Sse2 a, Floats8Sse2 b) {
    return {_mm_mul_ps(a.lower, b.lower), _mm_mul_ps(a.upper, b.upper)};
  }
  // Of a NaN and b, b.
  static Floats8Sse2 min(Floats8Sse2 a, Floats8Sse2 b) {
    return {_mm_min_ps(a.lower, b.lower), _mm_min_ps(a.upper, b.upper)};
  }
  static Floats8Sse2 max(Floats8Sse2 a, Floats8Sse2 b) {
    return {_mm_max_ps(a.lower, b.lower), _mm_max_ps(a.upper, b.upper)};
  }
  static Floats8Sse2 multiply_add(Floats8Sse2 a, Floats8Sse2 b, Floats8Sse2 c) { return a * b + c; }
  static Floats8Sse2 multiply_subtract(Floats8Sse2 a, Floats8Sse2 b, Floats8Sse2 c) { return a * b - c; }
  // c - a b
  static Floats8Sse2 subtract_from(Floats8Sse2 c, Floats8Sse2 a, Floats8Sse2 b) { return c - a * b; }
  static Floats8Sse2 absolute(Floats8Sse2 a) {
    const __m128 sign = _mm_set1_ps(-0.0f);
    return {_mm_andnot_ps(sign, a.lower), _mm_andnot_ps(sign, a.upper)};
  }
  __m128 first_four() const { return lower; }
  float first() const { return _mm_cvtss_f32(lower); }
  // 1 / a to a relative 1.5 / 4096
  static Floats8Sse2 reciprocal(Floats8Sse2 a) { return {_mm_rcp_ps(a.lower), _mm_rcp_ps(a.upper)}; }

  // a where x, y and z are all at least 0, else infinity
  static Floats8Sse2 where_not_negative(Floats8Sse2 x, Floats8Sse2 y, Floats8Sse2 z, Floats8Sse2 a) {
    const __m128 zero = _mm_setzero_ps(), none = _mm_set1_ps(__builtin_inff());
    const auto half = [&](__m128 hx, __m128 hy, __m128 hz, __m128 ha) {
      const __m128 good = _mm_cmpge_ps(_mm_min_ps(_mm_min_ps(hx, hy), hz), zero);
      return _mm_or_ps(_mm_and_ps(good, ha), _mm_andnot_ps(good, none));
    };
    return {half(x.lower, y.lower, z.lower, a.lower), half(x.upper, y.upper, z.upper, a.upper)};
  }
  // Bit i: a[i] <= b[i]
  static unsigned not_above(Floats8Sse2 a, Floats8Sse2 b) {
    return static_cast<unsigned>(_mm_movemask_ps(_mm_cmple_ps(a.lower, b.lower))) |
           static_cast<unsigned>(_mm_movemask_ps(_mm_cmple_ps(a.upper, b.upper))) << 4;
  }
  // a, at most kNothing, with the three lowest bits of each replaced by its place. Not to be negative.
  static Floats8Sse2 tagged(Floats8Sse2 a) {
    const auto half = [](__m128 x, __m128i places) {
      const __m128 finite = _mm_min_ps(x, _mm_set1_ps(kNothing));
      return _mm_castsi128_ps(_mm_or_si128(_mm_and_si128(_mm_castps_si128(finite), _mm_set1_epi32(~7)), places));
    };
    return {half(a.lower, _mm_setr_epi32(0, 1, 2, 3)), half(a.upper, _mm_setr_epi32(4, 5, 6, 7))};
  }
  // a with kNothing in place of x
  static Floats8Sse2 without(Floats8Sse2 a, float x) {
    const auto half = [x](__m128 h) {
      const __m128 gone = _mm_cmpeq_ps(h, _mm_set1_ps(x));
      return _mm_or_ps(_mm_andnot_ps(gone, h), _mm_and_ps(gone, _mm_set1_ps(kNothing)));
    };
    return {half(a.lower), half(a.upper)};
  }
  static float smallest(Floats8Sse2 a) {
    __m128 x = _mm_min_ps(a.lower, a.upper);
    x = _mm_min_ps(x, _mm_movehl_ps(x, x));
    return _mm_cvtss_f32(_mm_min_ss(x, _mm_shuffle_ps(x, x, 1)));
  }
};

}  // namespace asperity::bvh
