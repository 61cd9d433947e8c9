#pragma once

#include <immintrin.h>

#include <cstdint>

namespace asperity::bvh {

// Eight floats in a register of AVX2, with fused multiply-add. Only for files compiled for AVX2.
struct Floats8Avx2 {
  __m256 value;

  static constexpr float kNothing = 3.3e38f;

  static Floats8Avx2 all(float x) { return {_mm256_set1_ps(x)}; }
  static Floats8Avx2 load(const float* x) { return {_mm256_load_ps(x)}; }
  static Floats8Avx2 load(const std::uint16_t* x) {
    const __m128i whole = _mm_load_si128(reinterpret_cast<const __m128i*>(x));
    return {_mm256_cvtepi32_ps(_mm256_cvtepu16_epi32(whole))};
  }
  // (a - b) + c of three components, scaled and each in all places.
  static void spread(const float* a, const float* b, const float* c, float scale, Floats8Avx2& x, Floats8Avx2& y,
                     Floats8Avx2& z) {
    const __m128 q =
        _mm_mul_ps(_mm_add_ps(_mm_sub_ps(_mm_load_ps(a), _mm_load_ps(b)), _mm_load_ps(c)), _mm_set1_ps(scale));
    const __m256 twice = _mm256_set_m128(q, q);
    x.value = _mm256_permute_ps(twice, 0x00);
    y.value = _mm256_permute_ps(twice, 0x55);
    z.value = _mm256_permute_ps(twice, 0xaa);
  }
  void store(float* x) const { _mm256_store_ps(x, value); }

  friend Floats8Avx2 operator+(Floats8Avx2 a, Floats8Avx2 b) { return {_mm256_add_ps(a.value, b.value)}; }
  friend Floats8Avx2 operator-(Floats8Avx2 a, Floats8Avx2 b) { return {_mm256_sub_ps(a.value, b.value)}; }
  friend Floats8Avx2 operator*(Floats8Avx2 a, Floats8Avx2 b) { return {_mm256_mul_ps(a.value, b.value)}; }
  // Of a NaN and b, b.
  static Floats8Avx2 min(Floats8Avx2 a, Floats8Avx2 b) { return {_mm256_min_ps(a.value, b.value)}; }
  static Floats8Avx2 max(Floats8Avx2 a, Floats8Avx2 b) { return {_mm256_max_ps(a.value, b.value)}; }
  static Floats8Avx2 multiply_add(Floats8Avx2 a, Floats8Avx2 b, Floats8Avx2 c) {
    return {_mm256_fmadd_ps(a.value, b.value, c.value)};
  }
  static Floats8Avx2 multiply_subtract(Floats8Avx2 a, Floats8Avx2 b, Floats8Avx2 c) {
    return {_mm256_fmsub_ps(a.value, b.value, c.value)};
  }
  // c - a b
  static Floats8Avx2 subtract_from(Floats8Avx2 c, Floats8Avx2 a, Floats8Avx2 b) {
    return {_mm256_fnmadd_ps(a.value, b.value, c.value)};
  }
  static Floats8Avx2 absolute(Floats8Avx2 a) { return {_mm256_andnot_ps(_mm256_set1_ps(-0.0f), a.value)}; }
  __m128 first_four() const { return _mm256_castps256_ps128(value); }
  float first() const { return _mm256_cvtss_f32(value); }
  // 1 / a to a relative 1.5 / 4096
  static Floats8Avx2 reciprocal(Floats8Avx2 a) { return {_mm256_rcp_ps(a.value)}; }

  // a where x, y and z are all at least 0, else infinity
  static Floats8Avx2 where_not_negative(Floats8Avx2 x, Floats8Avx2 y, Floats8Avx2 z, Floats8Avx2 a) {
    const __m256 least = _mm256_min_ps(_mm256_min_ps(x.value, y.value), z.value);
    const __m256 good = _mm256_cmp_ps(least, _mm256_setzero_ps(), _CMP_GE_OQ);
    return {_mm256_blendv_ps(_mm256_set1_ps(__builtin_inff()), a.value, good)};
  }
  // Bit i: a[i] <= b[i]
  static unsigned not_above(Floats8Avx2 a, Floats8Avx2 b) {
    return static_cast<unsigned>(_mm256_movemask_ps(_mm256_cmp_ps(a.value, b.value, _CMP_LE_OQ)));
  }
  // a with the three lowest bits of each replaced by its place; infinity becomes a NaN. Not to be negative.
  static Floats8Avx2 tagged(Floats8Avx2 a) {
    const __m256i bits = _mm256_and_si256(_mm256_castps_si256(a.value), _mm256_set1_epi32(~7));
    return {_mm256_castsi256_ps(_mm256_or_si256(bits, _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7)))};
  }
  // a with kNothing in place of x
  static Floats8Avx2 without(Floats8Avx2 a, float x) {
    const __m256 gone = _mm256_cmp_ps(a.value, _mm256_set1_ps(x), _CMP_EQ_OQ);
    return {_mm256_blendv_ps(a.value, _mm256_set1_ps(kNothing), gone)};
  }
  // Compared as integers, which takes a fourth of the time and is the same for what is not negative. Among negative
  // numbers any may be returned, and of a NaN and a number the number.
  static float smallest(Floats8Avx2 a) {
    const __m256i bits = _mm256_castps_si256(a.value);
    __m128i x = _mm_min_epi32(_mm256_castsi256_si128(bits), _mm256_extracti128_si256(bits, 1));
    x = _mm_min_epi32(x, _mm_shuffle_epi32(x, 0x4e));
    x = _mm_min_epi32(x, _mm_shuffle_epi32(x, 0xb1));
    return _mm_cvtss_f32(_mm_castsi128_ps(x));
  }
};

}  // namespace asperity::bvh
