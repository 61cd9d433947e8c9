#pragma once

#include <memory>

#include <Eigen/Core>
#include <Eigen/SparseCore>

namespace asperity {

// A = Pᵀ L Lᵀ P of a sparse, symmetric, positive definite matrix, P from the approximate minimum degree ordering
// (Amestoy, Davis and Duff 1996), by Eigen, compiled once for all modules. One thread; the same matrix gives the same
// bits.
class SparseCholesky {
 public:
  // A: n × n, of which the lower triangle is read.
  explicit SparseCholesky(const Eigen::SparseMatrix<double>& A);
  ~SparseCholesky();
  SparseCholesky(SparseCholesky&&) noexcept;
  SparseCholesky& operator=(SparseCholesky&&) noexcept;

  // Another matrix of the same pattern: the ordering is kept.
  void factorize(const Eigen::SparseMatrix<double>& A);

  // A is positive definite and finite; otherwise nothing below may be called.
  bool positive_definite() const noexcept;

  // x with A x = b. b: n × k.
  Eigen::MatrixXd solve(const Eigen::MatrixXd& b) const;

  double log_determinant() const;

  // The entries of A⁻¹ where L + Lᵀ may have entries, at all places where A has one among them, by Takahashi's
  // recursion (Takahashi, Fagan and Chen 1973; Rue and Martino 2007), in A's order: symmetric, both triangles. The
  // cost is that of the factorisation, a few times over.
  Eigen::SparseMatrix<double> selected_inverse() const;

 private:
  struct Factor;
  std::unique_ptr<Factor> factor_;
};

}  // namespace asperity
