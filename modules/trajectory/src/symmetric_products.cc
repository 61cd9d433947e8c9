#include "symmetric_products.h"

#include <array>
#include <cstddef>

namespace asperity::inertial_smoother {

namespace {

#if defined(__x86_64__)
const bool kHasAvx2 = __builtin_cpu_supports("avx2") != 0;
#else
constexpr bool kHasAvx2 = false;
#endif

using Four [[gnu::vector_size(32)]] = double;

// Rows in whole fours.
constexpr int fours(int rows) { return (rows + 3) / 4; }

template <int F>
struct Padded {
  Four column[kMax][F];
};

// Two columns of A S at once, so that a column of A is read once for both.
template <int F>
[[gnu::always_inline]] inline void multiply(const Padded<F>& a, const double* s, int n, const FilledColumns& filled,
                                            Padded<F>& out) {
  const auto columns = [&](int j, int other) __attribute__((always_inline)) {
    Four sum0[F] = {}, sum1[F] = {};
    const double* s0 = s + static_cast<std::ptrdiff_t>(j) * n;
    const double* s1 = s + static_cast<std::ptrdiff_t>(other) * n;
    const auto add = [&](int from, int to) __attribute__((always_inline)) {
      for (int k = from; k < to; ++k) {
        for (int f = 0; f < F; ++f) {
          sum0[f] += a.column[k][f] * s0[k];
          sum1[f] += a.column[k][f] * s1[k];
        }
      }
    };
    add(filled.first, filled.skip);
    add(filled.resume, filled.last);
    for (int f = 0; f < F; ++f) {
      out.column[j][f] = sum0[f];
      out.column[other][f] = sum1[f];
    }
  };
  for (int j = 0; j + 1 < n; j += 2) columns(j, j + 1);
  if (n % 2 != 0) columns(n - 1, n - 1);
}

// The upper triangle of S + sign Aᵀ B, six rows of A and B at once; `across` is Aᵀ.
template <int R>
[[gnu::always_inline]] inline void add_upper(double sign, const double* __restrict across, const double* __restrict b,
                                             int n, double* __restrict S) {
  for (int j = 0; j < n; ++j) {
    double* __restrict s = S + static_cast<std::ptrdiff_t>(j) * n;
    for (int r = 0; r < R; r += 6) {
      const double* __restrict a0 = across + static_cast<std::ptrdiff_t>(r) * n;
      const double* __restrict a1 = a0 + n;
      const double* __restrict a2 = a1 + n;
      const double* __restrict a3 = a2 + n;
      const double* __restrict a4 = a3 + n;
      const double* __restrict a5 = a4 + n;
      const double* __restrict column = b + static_cast<std::ptrdiff_t>(j) * R + r;
      const double b0 = sign * column[0], b1 = sign * column[1], b2 = sign * column[2];
      const double b3 = sign * column[3], b4 = sign * column[4], b5 = sign * column[5];
      for (int i = 0; i <= j; ++i) {
        s[i] += (a0[i] * b0 + a1[i] * b1 + a2[i] * b2) + (a3[i] * b3 + a4[i] * b4 + a5[i] * b5);
      }
    }
  }
}

template <int F>
#if defined(__x86_64__)
[[gnu::target("avx2")]]
#endif
void multiply_avx2(const Padded<F>& a, const double* s, int n, const FilledColumns& filled,
                                           Padded<F>& out) {
  multiply<F>(a, s, n, filled, out);
}

template <int R>
#if defined(__x86_64__)
[[gnu::target("avx2")]]
#endif
void add_upper_avx2(double sign, const double* across, const double* b, int n, double* S) {
  add_upper<R>(sign, across, b, n, S);
}

void mirror_upper(Square& S) {
  for (Eigen::Index c = 1; c < S.cols(); ++c) {
    for (Eigen::Index r = 0; r < c; ++r) S(c, r) = S(r, c);
  }
}

}  // namespace

template <int R>
Rows<R> times_symmetric(const Rows<R>& A, const Square& S, const FilledColumns& filled) {
  constexpr int F = fours(R);
  const auto n = static_cast<int>(S.cols());
  Padded<F> a, product;
  const auto copy = [&](int from, int to) {
    for (int k = from; k < to; ++k) {
      a.column[k][F - 1] = Four{};
      for (int r = 0; r < R; ++r) a.column[k][r / 4][r % 4] = A(r, k);
    }
  };
  copy(filled.first, filled.skip);
  copy(filled.resume, filled.last);
  if (kHasAvx2) {
    multiply_avx2<F>(a, S.data(), n, filled, product);
  } else {
    multiply<F>(a, S.data(), n, filled, product);
  }
  Rows<R> out(R, n);
  for (int j = 0; j < n; ++j) {
    for (int r = 0; r < R; ++r) out(r, j) = product.column[j][r / 4][r % 4];
  }
  return out;
}

template <int R>
void add_transposed_product(double sign, const Rows<R>& A, const Rows<R>& B, Square& S) {
  const auto n = static_cast<int>(S.cols());
  const Eigen::Matrix<double, Eigen::Dynamic, R, 0, kMax, R> across = A.transpose();
  if (kHasAvx2) {
    add_upper_avx2<R>(sign, across.data(), B.data(), n, S.data());
  } else {
    add_upper<R>(sign, across.data(), B.data(), n, S.data());
  }
  mirror_upper(S);
}

template Rows<3> times_symmetric<3>(const Rows<3>&, const Square&, const FilledColumns&);
template Rows<6> times_symmetric<6>(const Rows<6>&, const Square&, const FilledColumns&);
template Rows<9> times_symmetric<9>(const Rows<9>&, const Square&, const FilledColumns&);
template void add_transposed_product<6>(double, const Rows<6>&, const Rows<6>&, Square&);
template void add_transposed_product<18>(double, const Rows<18>&, const Rows<18>&, Square&);

}  // namespace asperity::inertial_smoother
