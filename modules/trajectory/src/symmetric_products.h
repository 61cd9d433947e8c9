#pragma once

#include "inertial_smoother.h"

// Products of the filter's matrices, some 45 rows by 6 or 9: general products of that size spend most of their time in
// preparing. Plain loops, four numbers at once on processors with AVX2, in the same order: the same bytes on all.
namespace asperity::inertial_smoother {

template <int R>
using Rows = Eigen::Matrix<double, R, Eigen::Dynamic, 0, R, kMax>;

// The columns of a matrix that are not zero: from `first` to before `skip` and from `resume` to before `last`.
struct FilledColumns {
  int first = 0, skip = 0, resume = 0, last = 0;
};

// A S for a symmetric S. R is 3, 6 or 9.
template <int R>
Rows<R> times_symmetric(const Rows<R>& A, const Square& S, const FilledColumns& filled);

template <int R>
Rows<R> times_symmetric(const Rows<R>& A, const Square& S) {
  const auto n = static_cast<int>(S.cols());
  return times_symmetric<R>(A, S, {0, n, n, n});
}

// S ← S + sign Aᵀ B, of which only the upper triangle is computed: the sum must be symmetric. R is 6 or 18.
template <int R>
void add_transposed_product(double sign, const Rows<R>& A, const Rows<R>& B, Square& S);

}  // namespace asperity::inertial_smoother
