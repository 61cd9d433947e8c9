#include "asperity/algebra/sparse_cholesky.h"

#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>
#include <Eigen/LU>

namespace asperity {
namespace {

// A grid's Laplacian and something, with random couplings: sparse, positive definite.
Eigen::SparseMatrix<double> grid_matrix(int side, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> weight(0.2, 2.0);
  std::vector<Eigen::Triplet<double>> entries;
  const auto couple = [&](int a, int b) {
    const double w = weight(random);
    entries.emplace_back(a, a, w);
    entries.emplace_back(b, b, w);
    entries.emplace_back(a, b, -w);
    entries.emplace_back(b, a, -w);
  };
  for (int r = 0; r < side; ++r) {
    for (int c = 0; c < side; ++c) {
      const int i = r * side + c;
      entries.emplace_back(i, i, 0.1);
      if (c + 1 < side) couple(i, i + 1);
      if (r + 1 < side) couple(i, i + side);
    }
  }
  Eigen::SparseMatrix<double> out(side * side, side * side);
  out.setFromTriplets(entries.begin(), entries.end());
  return out;
}

TEST(SparseCholesky, AgreesWithDenseInverse) {
  const Eigen::SparseMatrix<double> A = grid_matrix(9, 4);
  const Eigen::MatrixXd dense = A;
  const Eigen::MatrixXd inverse = dense.inverse();  // by L U: another algorithm
  const SparseCholesky cholesky(A);
  ASSERT_TRUE(cholesky.positive_definite());
  const Eigen::MatrixXd b = Eigen::MatrixXd::Random(A.rows(), 3);
  EXPECT_LT((cholesky.solve(b) - inverse * b).cwiseAbs().maxCoeff(), 1e-11);
  EXPECT_NEAR(cholesky.log_determinant(), std::log(dense.determinant()), 1e-9);
  const Eigen::SparseMatrix<double> selected = cholesky.selected_inverse();
  EXPECT_GE(selected.nonZeros(), A.nonZeros());
  for (int j = 0; j < selected.outerSize(); ++j) {
    for (Eigen::SparseMatrix<double>::InnerIterator it(selected, j); it; ++it)
      EXPECT_NEAR(it.value(), inverse(it.row(), it.col()), 1e-11);
  }
  for (int j = 0; j < A.outerSize(); ++j) {
    for (Eigen::SparseMatrix<double>::InnerIterator it(A, j); it; ++it)
      EXPECT_NE(selected.coeff(it.row(), it.col()), 0.0) << "A has an entry there";
  }
}

TEST(SparseCholesky, ReportsAMatrixThatIsNotPositiveDefinite) {
  Eigen::SparseMatrix<double> A = grid_matrix(4, 1);
  A.coeffRef(5, 5) = -1.0;
  EXPECT_FALSE(SparseCholesky(A).positive_definite());
  for (const double wrong : {std::nan(""), HUGE_VAL}) {
    A.coeffRef(5, 5) = wrong;
    EXPECT_FALSE(SparseCholesky(A).positive_definite()) << wrong;
  }
}

TEST(SparseCholesky, KeepsItsOrderForAnotherMatrixOfThePattern) {
  SparseCholesky cholesky(grid_matrix(9, 4));
  const Eigen::SparseMatrix<double> other = grid_matrix(9, 5);
  cholesky.factorize(other);
  const Eigen::VectorXd b = Eigen::VectorXd::Ones(other.rows());
  EXPECT_LT((other * cholesky.solve(b) - b).cwiseAbs().maxCoeff(), 1e-11);
}

}  // namespace
}  // namespace asperity
