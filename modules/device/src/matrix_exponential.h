#pragma once

#include <algorithm>
#include <cmath>

#include <Eigen/Core>

namespace asperity {

// exp(a), by scaling, Taylor's series and squaring. For small systems of bounded norm; does not allocate.
template <int N>
Eigen::Matrix<double, N, N> matrix_exponential(const Eigen::Matrix<double, N, N>& a) noexcept {
  using Matrix = Eigen::Matrix<double, N, N>;
  constexpr int kTerms = 14;  // 2^-15 / 15! is below the rounding
  int exponent = 0;
  std::frexp(a.cwiseAbs().rowwise().sum().maxCoeff(), &exponent);
  const int squarings = std::max(0, exponent + 1);
  const Matrix scaled = std::ldexp(1.0, -squarings) * a;
  Matrix sum = Matrix::Identity();
  for (int i = kTerms; i > 0; --i) {
    const Matrix product = scaled.lazyProduct(sum);
    sum = Matrix::Identity() + product / i;
  }
  for (int i = 0; i < squarings; ++i) {
    const Matrix square = sum.lazyProduct(sum);
    sum = square;
  }
  return sum;
}

}  // namespace asperity
