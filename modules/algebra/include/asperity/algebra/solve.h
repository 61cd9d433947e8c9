#pragma once

#include <Eigen/Core>

namespace asperity {

// Dense linear algebra on matrices of any size, by Eigen, compiled once for all modules. Sizes that do not fit together
// are an error of the program (assertion); entries that are not finite give a result of nan,
// rank 0. Inner loops on
// small matrices of known size, and 3 × 3, call Eigen itself.

// x with A x = b by L D Lᵀ with pivoting (Golub & Van Loan 2013, §4.2, §4.4). A: n × n, symmetric, positive or negative
// semidefinite; of it the lower triangle is read. b: n × k.
Eigen::MatrixXd solve_symmetric(const Eigen::MatrixXd& A, const Eigen::MatrixXd& b);

// x with A x = b by L U with full pivoting. A: n × n, any; b: n × k.
Eigen::MatrixXd solve_square(const Eigen::MatrixXd& A, const Eigen::MatrixXd& b);

// A⁻¹ by L U with partial pivoting. A: n × n, regular.
Eigen::MatrixXd inverse_of(const Eigen::MatrixXd& A);

struct LeastSquares {
  Eigen::MatrixXd x;  // n × k
  Eigen::Index rank = 0;
};

// The x that minimises |A x − b|, of several the shortest, by the complete orthogonal decomposition of A (Golub & Van
// Loan 2013, §5.5). A: m × n, b: m × k. Pivots below `threshold` times the largest count as zero; 0 means the
// rounding of doubles times the smaller of m and n.
LeastSquares least_squares(const Eigen::MatrixXd& A, const Eigen::MatrixXd& b, double threshold = 0.0);

// A = U diag(values) Vᵀ by Jacobi's rotations, which keep the relative precision of small values; values fall.
struct SingularValues {
  Eigen::MatrixXd U;
  Eigen::VectorXd values;
  Eigen::MatrixXd V;
};
enum class SingularVectors {
  kNone,   // U and V stay empty
  kThinV,  // V: n × min(m, n)
  kFullV,  // V: n × n
  kThin    // U: m × min(m, n), V: n × min(m, n)
};
SingularValues singular_values(const Eigen::MatrixXd& A, SingularVectors vectors);

// A = vectors diag(values) vectorsᵀ; values rise, vectors are columns of length 1. A: n × n, symmetric, of which the
// lower triangle is read.
struct SymmetricEigen {
  Eigen::VectorXd values;
  Eigen::MatrixXd vectors;
};
SymmetricEigen symmetric_eigen(const Eigen::MatrixXd& A);

// A v = value B v, vectorsᵀ B vectors = I. B: n × n, symmetric, positive definite.
SymmetricEigen symmetric_eigen(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B);

// The eigenvalues of any square matrix, by its real Schur form; of a conjugate pair the one above the real axis first.
Eigen::VectorXcd eigenvalues(const Eigen::MatrixXd& A);

}  // namespace asperity
