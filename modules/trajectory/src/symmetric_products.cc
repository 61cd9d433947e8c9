#include "symmetric_products.h"

#include <array>
#include <cstddef>

#include "asperity/base/processor.h"

namespace asperity::inertial_smoother {

namespace {

using Four [[gnu::vector_size(32)]] = double;

// Rows in whole fours.
constexpr int fours(int rows) { return (rows + 3) / 4; }

template <int F>
struct Padded {
  Four column[kMax][F];
};

// A matrix X of Square's kind.
struct Columns {
  const double* data;
  int rows, columns;
};

// Two columns of A X at once, so that a column of A is read once for both.
template <int F>
[[gnu::always_inline]] inline void multiply(const Padded<F>& a, const Columns& x, const FilledColumns& filled,
                                            Padded<F>& out) {
  const auto columns = [&](int j, int other) __attribute__((always_inline)) {
    Four sum0[F] = {}, sum1[F] = {};
    const double* s0 = x.data + static_cast<std::ptrdiff_t>(j) * x.rows;
    const double* s1 = x.data + static_cast<std::ptrdiff_t>(other) * x.rows;
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
  for (int j = 0; j + 1 < x.columns; j += 2) columns(j, j + 1);
  if (x.columns % 2 != 0) columns(x.columns - 1, x.columns - 1);
}

// X + sign Aᵀ B of n rows, or its upper triangle, six rows of A and B at once; `across` is Aᵀ.
template <int R, bool Upper>
[[gnu::always_inline]] inline void add_rows(double sign, const double* __restrict across, const double* __restrict b,
                                            int n, int columns, double* __restrict X) {
  for (int j = 0; j < columns; ++j) {
    double* __restrict s = X + static_cast<std::ptrdiff_t>(j) * n;
    const int end = Upper ? j + 1 : n;
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
      for (int i = 0; i < end; ++i) {
        s[i] += (a0[i] * b0 + a1[i] * b1 + a2[i] * b2) + (a3[i] * b3 + a4[i] * b4 + a5[i] * b5);
      }
    }
  }
}

template <int F>
ASPERITY_TARGET_AVX2 void multiply_avx2(const Padded<F>& a, const Columns& x, const FilledColumns& filled,
                                        Padded<F>& out) {
  multiply<F>(a, x, filled, out);
}

template <int R, bool Upper>
ASPERITY_TARGET_AVX2 void add_rows_avx2(double sign, const double* across, const double* b, int n, int columns,
                                        double* X) {
  add_rows<R, Upper>(sign, across, b, n, columns, X);
}

template <int R, bool Upper>
void add_where_best(double sign, const Rows<R>& A, const Rows<R>& B, Square& X) {
  const auto n = static_cast<int>(X.rows()), columns = static_cast<int>(X.cols());
  const Eigen::Matrix<double, Eigen::Dynamic, R, 0, kMax, R> across = A.transpose();
  if (kProcessorHasAvx2) {
    add_rows_avx2<R, Upper>(sign, across.data(), B.data(), n, columns, X.data());
  } else {
    add_rows<R, Upper>(sign, across.data(), B.data(), n, columns, X.data());
  }
}

void mirror_upper(Square& S) {
  for (Eigen::Index c = 1; c < S.cols(); ++c) {
    for (Eigen::Index r = 0; r < c; ++r) S(c, r) = S(r, c);
  }
}

}  // namespace

template <int R>
Rows<R> rows_times(const Rows<R>& A, const Square& X, const FilledColumns& filled) {
  constexpr int F = fours(R);
  const Columns x{X.data(), static_cast<int>(X.rows()), static_cast<int>(X.cols())};
  Padded<F> a, product;
  const auto copy = [&](int from, int to) {
    for (int k = from; k < to; ++k) {
      a.column[k][F - 1] = Four{};
      for (int r = 0; r < R; ++r) a.column[k][r / 4][r % 4] = A(r, k);
    }
  };
  copy(filled.first, filled.skip);
  copy(filled.resume, filled.last);
  if (kProcessorHasAvx2) {
    multiply_avx2<F>(a, x, filled, product);
  } else {
    multiply<F>(a, x, filled, product);
  }
  Rows<R> out(R, x.columns);
  for (int j = 0; j < x.columns; ++j) {
    for (int r = 0; r < R; ++r) out(r, j) = product.column[j][r / 4][r % 4];
  }
  return out;
}

template <int R>
void add_product(double sign, const Rows<R>& A, const Rows<R>& B, Square& X) {
  add_where_best<R, false>(sign, A, B, X);
}

template <int R>
void add_transposed_product(double sign, const Rows<R>& A, const Rows<R>& B, Square& S) {
  add_where_best<R, true>(sign, A, B, S);
  mirror_upper(S);
}

template Rows<3> rows_times<3>(const Rows<3>&, const Square&, const FilledColumns&);
template Rows<6> rows_times<6>(const Rows<6>&, const Square&, const FilledColumns&);
template Rows<9> rows_times<9>(const Rows<9>&, const Square&, const FilledColumns&);
template void add_product<6>(double, const Rows<6>&, const Rows<6>&, Square&);
template void add_transposed_product<6>(double, const Rows<6>&, const Rows<6>&, Square&);
template void add_transposed_product<12>(double, const Rows<12>&, const Rows<12>&, Square&);
template void add_transposed_product<18>(double, const Rows<18>&, const Rows<18>&, Square&);

}  // namespace asperity::inertial_smoother
