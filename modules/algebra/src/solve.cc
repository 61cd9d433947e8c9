#include "asperity/algebra/solve.h"

#include <algorithm>
#include <complex>
#include <limits>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/QR>
#include <Eigen/SVD>

namespace asperity {

namespace {

unsigned svd_options(SingularVectors vectors) {
  switch (vectors) {
    case SingularVectors::kNone:
      return 0;
    case SingularVectors::kThinV:
      return Eigen::ComputeThinV;
    case SingularVectors::kFullV:
      return Eigen::ComputeFullV;
    case SingularVectors::kThin:
      return Eigen::ComputeThinU | Eigen::ComputeThinV;
  }
  return 0;
}

Eigen::MatrixXd not_numbers(Eigen::Index rows, Eigen::Index columns) {
  return Eigen::MatrixXd::Constant(rows, columns, std::numeric_limits<double>::quiet_NaN());
}

// Eigen leaves the results of entries that are not finite unset, or turns them into numbers.
bool are_finite(const Eigen::MatrixXd& A, const Eigen::MatrixXd& b) { return A.allFinite() && b.allFinite(); }

}  // namespace

Eigen::MatrixXd solve_symmetric(const Eigen::MatrixXd& A, const Eigen::MatrixXd& b) {
  if (!are_finite(A, b)) return not_numbers(A.cols(), b.cols());
  return Eigen::LDLT<Eigen::MatrixXd>(A).solve(b);
}

Eigen::MatrixXd solve_square(const Eigen::MatrixXd& A, const Eigen::MatrixXd& b) {
  if (!are_finite(A, b)) return not_numbers(A.cols(), b.cols());
  return Eigen::FullPivLU<Eigen::MatrixXd>(A).solve(b);
}

Eigen::MatrixXd inverse_of(const Eigen::MatrixXd& A) {
  if (!A.allFinite()) return not_numbers(A.rows(), A.cols());
  return A.inverse();
}

LeastSquares least_squares(const Eigen::MatrixXd& A, const Eigen::MatrixXd& b, double threshold) {
  if (!are_finite(A, b)) return {not_numbers(A.cols(), b.cols()), 0};
  Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> decomposition;
  if (threshold > 0.0) decomposition.setThreshold(threshold);
  decomposition.compute(A);
  return {decomposition.solve(b), decomposition.rank()};
}

SingularValues singular_values(const Eigen::MatrixXd& A, SingularVectors vectors) {
  SingularValues out;
  const Eigen::Index least = std::min(A.rows(), A.cols());
  if (!A.allFinite()) {
    out.values = not_numbers(least, 1);
    if (vectors == SingularVectors::kThin) out.U = not_numbers(A.rows(), least);
    if (vectors != SingularVectors::kNone)
      out.V = not_numbers(A.cols(), vectors == SingularVectors::kFullV ? A.cols() : least);
    return out;
  }
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(A, svd_options(vectors));
  out.values = svd.singularValues();
  if (svd.computeU()) out.U = svd.matrixU();
  if (svd.computeV()) out.V = svd.matrixV();
  return out;
}

SymmetricEigen symmetric_eigen(const Eigen::MatrixXd& A) {
  if (!A.allFinite()) return {not_numbers(A.rows(), 1), not_numbers(A.rows(), A.cols())};
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(A);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

SymmetricEigen symmetric_eigen(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B) {
  if (!are_finite(A, B)) return {not_numbers(A.rows(), 1), not_numbers(A.rows(), A.cols())};
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> solver(A, B);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

Eigen::VectorXcd eigenvalues(const Eigen::MatrixXd& A) {
  if (!A.allFinite()) return not_numbers(A.rows(), 1).cast<std::complex<double>>();
  return Eigen::EigenSolver<Eigen::MatrixXd>(A, false).eigenvalues();
}

}  // namespace asperity
