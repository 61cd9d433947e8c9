#include "fourier_pass.h"

#include <array>

namespace asperity {
namespace {

struct Number {
  double re, im;
};
[[gnu::always_inline]] inline Number operator+(Number a, Number b) { return {a.re + b.re, a.im + b.im}; }
[[gnu::always_inline]] inline Number operator-(Number a, Number b) { return {a.re - b.re, a.im - b.im}; }
[[gnu::always_inline]] inline Number operator*(Number a, Number b) {
  return {a.re * b.re - a.im * b.im, a.re * b.im + a.im * b.re};
}

template <std::size_t R>
[[gnu::always_inline]] inline std::array<Number, R> butterfly(const std::array<Number, R>& a) {
  const auto by_minus_i = [](Number x) { return Number{x.im, -x.re}; };
  if constexpr (R == 2) {
    return {a[0] + a[1], a[0] - a[1]};
  } else if constexpr (R == 3) {
    constexpr double s = 0.86602540378443864676;  // sin 60°
    const Number sum = a[1] + a[2], turned = by_minus_i(a[1] - a[2]);
    const Number mean{a[0].re - 0.5 * sum.re, a[0].im - 0.5 * sum.im}, side{s * turned.re, s * turned.im};
    return {a[0] + sum, mean + side, mean - side};
  } else if constexpr (R == 4) {
    const Number even = a[0] + a[2], odd = a[0] - a[2], sum = a[1] + a[3], turned = by_minus_i(a[1] - a[3]);
    return {even + sum, odd + turned, even - sum, odd - turned};
  } else {
    static_assert(R == 5);
    constexpr double c1 = 0.30901699437494742410, c2 = -0.80901699437494742410;  // cos 72°, cos 144°
    constexpr double s1 = 0.95105651629515357212, s2 = 0.58778525229247312917;   // sin 72°, sin 144°
    const Number p = a[1] + a[4], q = a[2] + a[3], u = by_minus_i(a[1] - a[4]), v = by_minus_i(a[2] - a[3]);
    const Number m1{a[0].re + c1 * p.re + c2 * q.re, a[0].im + c1 * p.im + c2 * q.im};
    const Number m2{a[0].re + c2 * p.re + c1 * q.re, a[0].im + c2 * p.im + c1 * q.im};
    const Number w1{s1 * u.re + s2 * v.re, s1 * u.im + s2 * v.im};
    const Number w2{s2 * u.re - s1 * v.re, s2 * u.im - s1 * v.im};
    return {a[0] + p + q, m1 + w1, m2 + w2, m2 - w2, m1 - w1};
  }
}

template <std::size_t R>
[[gnu::always_inline]] inline void pass_of_radix(const Pass& pass, const Roots& root, View x, View y) {
  const std::size_t s = pass.stride, m = pass.length / R;
  const auto one = [&](std::size_t from, std::size_t to, const std::array<Number, R>& w) {
    std::array<Number, R> a;
    for (std::size_t k = 0; k < R; ++k) a[k] = {x.re[from + s * m * k], x.im[from + s * m * k]};
    const std::array<Number, R> b = butterfly<R>(a);
    y.re[to] = b[0].re;
    y.im[to] = b[0].im;
    for (std::size_t j = 1; j < R; ++j) {
      const Number out = b[j] * w[j];
      y.re[to + s * j] = out.re;
      y.im[to + s * j] = out.im;
    }
  };
  const auto roots_at = [&](std::size_t p) {
    std::array<Number, R> w{};
    for (std::size_t j = 1; j < R; ++j) w[j] = {root.re[j * p * root.step], root.im[j * p * root.step]};
    return w;
  };
  if (s == 1) {
    for (std::size_t p = 0; p < m; ++p) one(p, R * p, roots_at(p));
    return;
  }
  for (std::size_t p = 0; p < m; ++p) {
    const std::array<Number, R> w = roots_at(p);
    for (std::size_t q = 0; q < s; ++q) one(q + s * p, q + s * R * p, w);
  }
}

[[gnu::always_inline]] inline void dispatch(const Pass& pass, const Roots& root, View x, View y) {
  if (pass.radix == 4) pass_of_radix<4>(pass, root, x, y);
  if (pass.radix == 2) pass_of_radix<2>(pass, root, x, y);
  if (pass.radix == 3) pass_of_radix<3>(pass, root, x, y);
  if (pass.radix == 5) pass_of_radix<5>(pass, root, x, y);
}

#if defined(__x86_64__)
[[gnu::target("avx2")]]
#endif
void run_avx2(const Pass& pass, const Roots& root, View x, View y) {
  dispatch(pass, root, x, y);
}

void run_sse2(const Pass& pass, const Roots& root, View x, View y) { dispatch(pass, root, x, y); }

#if defined(__x86_64__)
const bool kHasAvx2 = __builtin_cpu_supports("avx2") != 0;
#else
constexpr bool kHasAvx2 = false;
#endif

}  // namespace

void run_pass(const Pass& pass, const Roots& root, View x, View y) {
  if (kHasAvx2) {
    run_avx2(pass, root, x, y);
  } else {
    run_sse2(pass, root, x, y);
  }
}

}  // namespace asperity
