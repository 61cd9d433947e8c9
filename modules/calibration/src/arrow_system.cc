#include "arrow_system.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>

namespace asperity {

ArrowSystem::ArrowSystem(Eigen::Index points, Eigen::Index parameters)
    : band_(Eigen::MatrixXd::Zero(kLocal, kPoint * points)),
      border_(Eigen::MatrixXd::Zero(kPoint * points, parameters)),
      corner_(Eigen::MatrixXd::Zero(parameters, parameters)),
      gradient_(Eigen::VectorXd::Zero(kPoint * points)),
      corner_gradient_(Eigen::VectorXd::Zero(parameters)) {}

bool ArrowSystem::factorise() {
  const Eigen::Index size = band_.cols();
  for (Eigen::Index j = 0; j < size; ++j) {
    if (!(band_(0, j) > 0.0)) return false;
    band_.col(j) /= std::sqrt(band_(0, j));
    const Eigen::Index last = std::min(kLocal, size - j);
    for (Eigen::Index k = 1; k < last; ++k) {
      band_.col(j + k).head(last - k).noalias() -= band_(k, j) * band_.col(j).segment(k, last - k);
    }
  }
  taken_up_ = border_;
  solve_band(taken_up_);
  Eigen::MatrixXd schur = corner_ - border_.transpose() * taken_up_;
  schur = (0.5 * (schur + schur.transpose())).eval();
  // Parameters have units of their own.
  const Eigen::VectorXd scale = schur.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
  const Eigen::LLT<Eigen::MatrixXd> factor(scale.asDiagonal() * schur * scale.asDiagonal());
  if (factor.info() != Eigen::Success) return false;
  covariance_ =
      scale.asDiagonal() * factor.solve(Eigen::MatrixXd::Identity(schur.rows(), schur.cols())) * scale.asDiagonal();
  return covariance_.allFinite();
}

void ArrowSystem::solve_band(Eigen::Ref<Eigen::MatrixXd> right) const {
  const Eigen::Index size = band_.cols();
  for (Eigen::Index column = 0; column < right.cols(); ++column) {
    auto x = right.col(column);
    for (Eigen::Index j = 0; j < size; ++j) {
      const Eigen::Index last = std::min(kLocal, size - j);
      x[j] /= band_(0, j);
      x.segment(j + 1, last - 1).noalias() -= x[j] * band_.col(j).segment(1, last - 1);
    }
    for (Eigen::Index j = size - 1; j >= 0; --j) {
      const Eigen::Index last = std::min(kLocal, size - j);
      x[j] = (x[j] - band_.col(j).segment(1, last - 1).dot(x.segment(j + 1, last - 1))) / band_(0, j);
    }
  }
}

void ArrowSystem::solve(Eigen::MatrixXd& points, Eigen::MatrixXd& parameters) const {
  solve_band(points);
  parameters = (covariance_ * (parameters - border_.transpose() * points)).eval();
  points.noalias() -= taken_up_ * parameters;
}

void ArrowSystem::solve(Eigen::VectorXd& points, Eigen::VectorXd& parameters) const {
  Eigen::MatrixXd upper = -gradient_, lower = -corner_gradient_;
  solve(upper, lower);
  points = upper;
  parameters = lower;
}

}  // namespace asperity
