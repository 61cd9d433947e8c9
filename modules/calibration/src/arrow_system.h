#pragma once

#include <Eigen/Core>

namespace asperity {

// The normal equations of least squares over the six control points' neighbourhoods of a B-spline of the fifth degree,
// six unknowns a point, beside a few parameters that every row may touch: [S B; Bᵀ C], S banded.
class ArrowSystem {
 public:
  static constexpr Eigen::Index kPoint = 6, kSupport = 6, kLocal = kPoint * kSupport;

  ArrowSystem(Eigen::Index points, Eigen::Index parameters);

  // Adds Jᵀ J and Jᵀ r of rows: `local` by the control points from `first` on, `global` by the parameters.
  template <class Local, class Global, class Residual>
  void add(Eigen::Index first, const Local& local, const Global& global, const Residual& residual) {
    const Eigen::Index at = kPoint * first;
    for (Eigen::Index column = 0; column < kLocal; ++column) {
      const Eigen::Index below = kLocal - column;
      band_.col(at + column).head(below).noalias() += local.rightCols(below).transpose() * local.col(column);
    }
    gradient_.segment(at, kLocal).noalias() += local.transpose() * residual;
    border_.middleRows(at, kLocal).noalias() += local.transpose() * global;
    corner_.noalias() += global.transpose() * global;
    corner_gradient_.noalias() += global.transpose() * residual;
  }

  // Adds `weight` to the diagonal of a parameter, with the gradient `weight · residual`.
  void add_prior(Eigen::Index parameter, double residual, double weight) {
    corner_(parameter, parameter) += weight;
    corner_gradient_[parameter] += weight * residual;
  }

  // Factorises; false where the system is singular.
  bool factorise();
  // After factorise(): the step that makes the sum least, −A⁻¹ Jᵀ r, points first.
  void solve(Eigen::VectorXd& points, Eigen::VectorXd& parameters) const;
  // A⁻¹ of right-hand sides, points above parameters.
  void solve(Eigen::MatrixXd& points, Eigen::MatrixXd& parameters) const;
  // The parameters' covariance, the points being free.
  const Eigen::MatrixXd& covariance() const { return covariance_; }
  // S⁻¹ B: by it rows lose what the points take up, J_parameters − J_points S⁻¹ B.
  const Eigen::MatrixXd& taken_up() const { return taken_up_; }

 private:
  void solve_band(Eigen::Ref<Eigen::MatrixXd> right) const;

  Eigen::MatrixXd band_;    // below the diagonal, a column a column
  Eigen::MatrixXd border_;  // B
  Eigen::MatrixXd corner_, taken_up_, covariance_;
  Eigen::VectorXd gradient_, corner_gradient_;
};

}  // namespace asperity
