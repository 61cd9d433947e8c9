#include "asperity/algebra/solve.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace asperity {
namespace {

// Oracles: the equations that define each result, and matrices whose answer is known in closed form. Tolerances:
// rounding of doubles (2·10⁻¹⁶) times the size and the condition (below 10⁴) of the matrices here.
constexpr double kTolerance = 1e-11;

Eigen::MatrixXd random_matrix(Eigen::Index rows, Eigen::Index columns, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> entry(-1.0, 1.0);
  Eigen::MatrixXd out(rows, columns);
  for (Eigen::Index i = 0; i < rows; ++i)
    for (Eigen::Index k = 0; k < columns; ++k) out(i, k) = entry(random);
  return out;
}

TEST(Solve, SymmetricSystemsAreSolvedAndOnlyTheLowerTriangleIsRead) {
  const Eigen::MatrixXd G = random_matrix(12, 5, 1);
  Eigen::MatrixXd A = G.transpose() * G;
  const Eigen::MatrixXd whole = A;
  const Eigen::MatrixXd b = random_matrix(5, 3, 2);
  A.triangularView<Eigen::StrictlyUpper>().setConstant(7.0);
  EXPECT_LT((whole * solve_symmetric(A, b) - b).norm(), kTolerance);
}

TEST(Solve, SquareSystemsThatNeedPivotsAreSolved) {
  Eigen::MatrixXd A(3, 3);
  A << 0.0, 2.0, 0.0, 0.0, 0.0, 4.0, 1.0, 0.0, 0.0;
  const Eigen::Vector3d x = solve_square(A, Eigen::Vector3d(2.0, 8.0, 3.0));
  EXPECT_LT((x - Eigen::Vector3d(3.0, 1.0, 2.0)).norm(), kTolerance);
  EXPECT_LT((A * inverse_of(A) - Eigen::Matrix3d::Identity()).norm(), kTolerance);
}

TEST(Solve, TheInverseOfHilbertsMatrixIsOfWholeNumbers) {
  Eigen::MatrixXd A(3, 3);
  A << 1.0, 1.0 / 2.0, 1.0 / 3.0, 1.0 / 2.0, 1.0 / 3.0, 1.0 / 4.0, 1.0 / 3.0, 1.0 / 4.0, 1.0 / 5.0;
  Eigen::Matrix3d exact;
  exact << 9.0, -36.0, 30.0, -36.0, 192.0, -180.0, 30.0, -180.0, 180.0;
  EXPECT_LT((inverse_of(A) - exact).norm(), 1e-9);  // condition 524
}

TEST(Solve, WhatLeastSquaresLeavesIsPerpendicularToTheColumns) {
  const Eigen::MatrixXd A = random_matrix(20, 4, 3);
  const Eigen::MatrixXd b = random_matrix(20, 2, 4);
  const LeastSquares fit = least_squares(A, b);
  EXPECT_EQ(fit.rank, 4);
  EXPECT_LT((A.transpose() * (b - A * fit.x)).norm(), kTolerance);
}

TEST(Solve, OfManyLeastSquaresTheShortestIsTaken) {
  // x + y = 2: (1, 1) is the nearest to the origin.
  const LeastSquares fit = least_squares(Eigen::MatrixXd::Ones(3, 2), Eigen::MatrixXd::Constant(3, 1, 2.0));
  EXPECT_EQ(fit.rank, 1);
  EXPECT_LT((fit.x - Eigen::MatrixXd::Ones(2, 1)).norm(), kTolerance);
}

TEST(Solve, TheThresholdSaysWhatCountsAsZero) {
  Eigen::MatrixXd A = Eigen::MatrixXd::Identity(2, 2);
  A(1, 1) = 1e-5;
  const Eigen::MatrixXd b = Eigen::MatrixXd::Ones(2, 1);
  EXPECT_EQ(least_squares(A, b).rank, 2);
  EXPECT_EQ(least_squares(A, b, 1e-4).rank, 1);
}

TEST(Solve, SingularValuesAndVectorsMakeTheMatrixAgain) {
  for (const auto& [rows, columns] : {std::pair{7, 3}, std::pair{3, 7}, std::pair{4, 4}}) {
    const Eigen::MatrixXd A = random_matrix(rows, columns, 5);
    const SingularValues thin = singular_values(A, SingularVectors::kThin);
    EXPECT_LT((thin.U * thin.values.asDiagonal() * thin.V.transpose() - A).norm(), kTolerance);
    EXPECT_EQ(singular_values(A, SingularVectors::kThinV).V, thin.V);
    EXPECT_LT((singular_values(A, SingularVectors::kNone).values - thin.values).norm(), kTolerance);
    for (Eigen::Index i = 1; i < thin.values.size(); ++i) EXPECT_GE(thin.values[i - 1], thin.values[i]);
    const Eigen::MatrixXd V = singular_values(A, SingularVectors::kFullV).V;
    ASSERT_EQ(V.cols(), columns);
    EXPECT_LT((V.transpose() * V - Eigen::MatrixXd::Identity(columns, columns)).norm(), kTolerance);
  }
}

TEST(Solve, TheChainOfSpringsHasItsKnownFrequencies) {
  // −1, 2, −1 of n masses: 2 − 2 cos(kπ/(n + 1)).
  constexpr int kMasses = 9;
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(kMasses, kMasses);
  A.diagonal().setConstant(2.0);
  A.diagonal(-1).setConstant(-1.0);  // only the lower triangle is read
  const SymmetricEigen chain = symmetric_eigen(A);
  for (int k = 0; k < kMasses; ++k) {
    EXPECT_NEAR(chain.values[k], 2.0 - 2.0 * std::cos((k + 1) * M_PI / (kMasses + 1)), kTolerance);
  }
  EXPECT_LT((chain.vectors.transpose() * chain.vectors - Eigen::MatrixXd::Identity(kMasses, kMasses)).norm(),
            kTolerance);
}

TEST(Solve, TheGeneralisedVectorsDiagonaliseBothMatrices) {
  const Eigen::MatrixXd G = random_matrix(9, 6, 6), H = random_matrix(9, 6, 7);
  const Eigen::MatrixXd A = G.transpose() * G, B = H.transpose() * H;
  const SymmetricEigen both = symmetric_eigen(A, B);
  const double size = both.vectors.norm();
  EXPECT_LT((both.vectors.transpose() * B * both.vectors - Eigen::MatrixXd::Identity(6, 6)).norm(), kTolerance * size);
  EXPECT_LT((A * both.vectors - B * both.vectors * both.values.asDiagonal()).norm(), kTolerance * size);
}

TEST(Solve, WhatIsNotFiniteGivesNoNumber) {
  for (const double bad : {std::nan(""), HUGE_VAL}) {
    Eigen::MatrixXd A = random_matrix(3, 3, 8);
    A(2, 1) = bad;
    const Eigen::MatrixXd b = Eigen::MatrixXd::Ones(3, 2);
    EXPECT_TRUE(solve_symmetric(A, b).array().isNaN().all());
    EXPECT_TRUE(solve_square(A, b).array().isNaN().all());
    EXPECT_TRUE(inverse_of(A).array().isNaN().all());
    EXPECT_TRUE(least_squares(A, b).x.array().isNaN().all());
    EXPECT_EQ(least_squares(A, b).rank, 0);
    EXPECT_TRUE(singular_values(A, SingularVectors::kThin).values.array().isNaN().all());
    EXPECT_TRUE(singular_values(A, SingularVectors::kFullV).V.array().isNaN().all());
    EXPECT_TRUE(symmetric_eigen(A).values.array().isNaN().all());
    EXPECT_TRUE(symmetric_eigen(A, Eigen::Matrix3d::Identity()).vectors.array().isNaN().all());
    EXPECT_TRUE(eigenvalues(A).real().array().isNaN().all());
  }
}

TEST(Solve, ARotationsEigenvaluesLieOnTheUnitCircle) {
  Eigen::MatrixXd R(2, 2);
  R << std::cos(0.3), -std::sin(0.3), std::sin(0.3), std::cos(0.3);
  const Eigen::VectorXcd values = eigenvalues(0.9 * R);
  EXPECT_LT(std::abs(values[0] - std::polar(0.9, 0.3)), kTolerance);
  EXPECT_LT(std::abs(values[1] - std::polar(0.9, -0.3)), kTolerance);
}

}  // namespace
}  // namespace asperity
