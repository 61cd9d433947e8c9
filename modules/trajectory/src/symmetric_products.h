#pragma once

#include <array>

#include "inertial_smoother.h"

// Products of the filter's matrices, some 45 rows by 6 or 9: general products of that size spend most of their time in
// preparing. Plain loops over columns, which the compiler turns into vector instructions.
namespace asperity::inertial_smoother {

template <int R>
using Rows = Eigen::Matrix<double, R, Eigen::Dynamic, 0, R, kMax>;

// A S for a symmetric S; of A only the columns from `first` to before `last` are not zero, those of [skip, resume)
// are zero as well.
template <int R>
Rows<R> times_symmetric(const Rows<R>& A, const Square& S, int first, int skip, int resume, int last) {
  constexpr int kPadded = (R + 1) / 2 * 2;
  using Column = Eigen::Matrix<double, kPadded, 1>;
  std::array<Column, kMax> a;
  for (int k = first; k < last; ++k) {
    Column& column = a[static_cast<std::size_t>(k)];
    column[kPadded - 1] = 0.0;
    column.template head<R>() = A.col(k);
  }
  const auto n = static_cast<int>(S.cols());
  Rows<R> out(R, n);
  const auto columns = [&](int j, int other) {  // two at once
    Column sum0 = Column::Zero(), sum1 = Column::Zero();
    const double* s0 = S.data() + static_cast<std::ptrdiff_t>(j) * n;
    const double* s1 = S.data() + static_cast<std::ptrdiff_t>(other) * n;
    const auto add = [&](int from, int to) {
      for (int k = from; k < to; ++k) {
        const Column& column = a[static_cast<std::size_t>(k)];
        sum0 += column * s0[k];
        sum1 += column * s1[k];
      }
    };
    add(first, skip);
    add(resume, last);
    out.col(j) = sum0.template head<R>();
    out.col(other) = sum1.template head<R>();
  };
  for (int j = 0; j + 1 < n; j += 2) columns(j, j + 1);
  if (n % 2 != 0) columns(n - 1, n - 1);
  return out;
}

template <int R>
Rows<R> times_symmetric(const Rows<R>& A, const Square& S) {
  const auto n = static_cast<int>(S.cols());
  return times_symmetric<R>(A, S, 0, n, n, n);
}

inline void mirror_upper(Square& S) {
  for (Eigen::Index c = 1; c < S.cols(); ++c) {
    for (Eigen::Index r = 0; r < c; ++r) S(c, r) = S(r, c);
  }
}

// S ← S + sign Aᵀ B, of which only the upper triangle is computed: the sum must be symmetric.
template <int R>
void add_transposed_product(double sign, const Rows<R>& A, const Rows<R>& B, Square& S) {
  const auto n = static_cast<int>(S.cols());
  Eigen::Matrix<double, Eigen::Dynamic, R, 0, kMax, R> across = A.transpose();
  for (int j = 0; j < n; ++j) {
    double* __restrict s = S.data() + static_cast<std::ptrdiff_t>(j) * n;
    for (int r = 0; r < R; r += 6) {
      const double* __restrict a0 = across.data() + static_cast<std::ptrdiff_t>(r) * n;
      const double* __restrict a1 = a0 + n;
      const double* __restrict a2 = a1 + n;
      const double* __restrict a3 = a2 + n;
      const double* __restrict a4 = a3 + n;
      const double* __restrict a5 = a4 + n;
      const double b0 = sign * B(r, j), b1 = sign * B(r + 1, j), b2 = sign * B(r + 2, j);
      const double b3 = sign * B(r + 3, j), b4 = sign * B(r + 4, j), b5 = sign * B(r + 5, j);
      for (int i = 0; i <= j; ++i) {
        s[i] += (a0[i] * b0 + a1[i] * b1 + a2[i] * b2) + (a3[i] * b3 + a4[i] * b4 + a5[i] * b5);
      }
    }
  }
  mirror_upper(S);
}

}  // namespace asperity::inertial_smoother
