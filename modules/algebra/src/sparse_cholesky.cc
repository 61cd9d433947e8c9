#include "asperity/algebra/sparse_cholesky.h"

#include <cmath>
#include <utility>
#include <vector>

#include <Eigen/SparseCholesky>

namespace asperity {

struct SparseCholesky::Factor {
  Eigen::SimplicialLLT<Eigen::SparseMatrix<double>, Eigen::Lower> llt;
};

SparseCholesky::SparseCholesky(const Eigen::SparseMatrix<double>& A) : factor_(std::make_unique<Factor>()) {
  factor_->llt.analyzePattern(A);
  factor_->llt.factorize(A);
}
SparseCholesky::~SparseCholesky() = default;
SparseCholesky::SparseCholesky(SparseCholesky&&) noexcept = default;
SparseCholesky& SparseCholesky::operator=(SparseCholesky&&) noexcept = default;

void SparseCholesky::factorize(const Eigen::SparseMatrix<double>& A) { factor_->llt.factorize(A); }

bool SparseCholesky::positive_definite() const noexcept {
  if (factor_->llt.info() != Eigen::Success) return false;
  // Eigen takes a pivot that is no number for a positive one.
  const Eigen::SparseMatrix<double>& L = factor_->llt.matrixL().nestedExpression();
  for (Eigen::Index j = 0; j < L.cols(); ++j) {
    if (!std::isfinite(L.valuePtr()[L.outerIndexPtr()[j]])) return false;
  }
  return true;
}

Eigen::MatrixXd SparseCholesky::solve(const Eigen::MatrixXd& b) const { return factor_->llt.solve(b); }

double SparseCholesky::log_determinant() const {
  const Eigen::SparseMatrix<double>& L = factor_->llt.matrixL().nestedExpression();
  double out = 0.0;
  for (Eigen::Index j = 0; j < L.cols(); ++j) out += 2.0 * std::log(L.valuePtr()[L.outerIndexPtr()[j]]);
  return out;
}

Eigen::SparseMatrix<double> SparseCholesky::selected_inverse() const {
  const Eigen::SparseMatrix<double>& L = factor_->llt.matrixL().nestedExpression();
  const Eigen::Index n = L.cols();
  const auto* first = L.outerIndexPtr();
  const auto* row = L.innerIndexPtr();  // of each column rising, the diagonal first
  const double* l = L.valuePtr();
  std::vector<double> z(static_cast<std::size_t>(L.nonZeros()), 0.0);
  std::vector<double> x(static_cast<std::size_t>(n), 0.0), y(static_cast<std::size_t>(n), 0.0);
  std::vector<char> in_column(static_cast<std::size_t>(n), 0);
  const auto at = [](auto i) { return static_cast<std::size_t>(i); };
  for (Eigen::Index j = n - 1; j >= 0; --j) {
    const auto begin = first[j] + 1, end = first[j + 1];
    const double pivot = l[first[j]];
    for (auto p = begin; p < end; ++p) {
      x[at(row[p])] = l[p];
      in_column[at(row[p])] = 1;
    }
    // y = Z x over the rows of this column, which are all in the pattern of Z's columns k.
    for (auto p = begin; p < end; ++p) {
      const auto k = row[p];
      const double x_k = x[at(k)];
      double sum = z[at(first[k])] * x_k;
      for (auto q = first[k] + 1; q < first[k + 1]; ++q) {
        const auto r = at(row[q]);
        if (in_column[r] == 0) continue;
        sum += z[at(q)] * x[r];
        y[r] += z[at(q)] * x_k;
      }
      y[at(k)] += sum;
    }
    double diagonal = 1.0 / (pivot * pivot);
    for (auto p = begin; p < end; ++p) {
      const auto r = at(row[p]);
      z[at(p)] = -y[r] / pivot;
      diagonal -= l[p] * z[at(p)] / pivot;
      x[r] = y[r] = 0.0;
      in_column[r] = 0;
    }
    z[at(first[j])] = diagonal;
  }
  const auto& place = factor_->llt.permutationPinv().indices();
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(2 * z.size());
  for (Eigen::Index j = 0; j < n; ++j) {
    for (auto p = first[j]; p < first[j + 1]; ++p) {
      const auto a = place[row[p]], b = place[j];
      entries.emplace_back(a, b, z[at(p)]);
      if (a != b) entries.emplace_back(b, a, z[at(p)]);
    }
  }
  Eigen::SparseMatrix<double> out(n, n);
  out.setFromTriplets(entries.begin(), entries.end());
  return out;
}

}  // namespace asperity
