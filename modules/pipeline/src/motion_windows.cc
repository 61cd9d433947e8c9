#include "motion_windows.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>
#include <Eigen/QR>

namespace asperity {

namespace {

constexpr Eigen::Index kLeastFreedom = 30;
constexpr double kCalibrated = 0.01;  // what good calibrations of axes and scales leave, an element

}  // namespace

WindowScale scale_of_windows(std::span<const MotionWindow> windows) {
  WindowScale out;
  const auto rows = static_cast<Eigen::Index>(3 * windows.size());
  if (rows < 9 + kLeastFreedom) return out;
  Eigen::MatrixXd nuisance(rows, 9), matrix = Eigen::MatrixXd::Zero(rows, 9);
  Eigen::VectorXd left(rows), scale(rows);
  for (std::size_t i = 0; i < windows.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(3 * i);
    const MotionWindow& window = windows[i];
    nuisance.block<3, 3>(row, 0) = window.rotation_per_s2;
    nuisance.block<3, 3>(row, 3) = window.rotation;
    nuisance.block<3, 3>(row, 6).setIdentity();
    left.segment<3>(row) = window.tracker_mps2;
    scale.segment<3>(row) = window.inertial_mps2;
    for (int axis = 0; axis < 3; ++axis)
      matrix.block<3, 3>(row, 3 * axis).diagonal().setConstant(window.inertial_mps2[axis]);
  }
  if (!left.allFinite() || !nuisance.allFinite() || !scale.allFinite()) return out;
  // Frisch and Waugh: what the nuisances do not explain of either side.
  const Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> others(nuisance);
  const auto rest = [&](const auto& of) { return (of - nuisance * others.solve(of)).eval(); };
  const Eigen::VectorXd x = rest(scale), y = rest(left);
  const auto freedom = static_cast<double>(rows - others.rank() - 1);
  const double power = x.squaredNorm();
  if (freedom < static_cast<double>(kLeastFreedom) || !(power > 1e-9 * scale.squaredNorm())) return out;
  const double slope = x.dot(y) / power;
  const Eigen::VectorXd residual = y - slope * x;
  double neighbours = 0.0, own = 0.0, before = 0.0;
  for (Eigen::Index row = 0; row < rows; row += 3) {
    const double score = x.segment<3>(row).dot(residual.segment<3>(row));
    own += score * score;
    neighbours += score * before;  // Bartlett's weight at one lag of two: a half, twice
    before = score;
  }
  const double classical = residual.squaredNorm() / freedom / power;
  out.error = slope - 1.0;
  out.sigma = std::sqrt(std::max({classical, (own + neighbours) / (power * power), own / (power * power)}));

  const Eigen::MatrixXd X = rest(matrix);
  const Eigen::Matrix<double, 9, 9> information = X.transpose() * X;
  const Eigen::LDLT<Eigen::Matrix<double, 9, 9>> factor(information);
  if (factor.info() != Eigen::Success || !(factor.vectorD().minCoeff() > 1e-9 * factor.vectorD().maxCoeff()))
    return out;
  Eigen::Matrix<double, 9, 1> error = factor.solve(X.transpose() * y);
  const double variance = (y - X * error).squaredNorm() / (freedom - 8.0);
  for (const Eigen::Index diagonal : {0, 4, 8}) error[diagonal] -= 1.0;
  Eigen::Matrix<double, 9, 9> covariance = variance * factor.solve(Eigen::Matrix<double, 9, 9>::Identity());
  covariance.diagonal().array() += kCalibrated * kCalibrated;
  out.axes_chi2 = error.dot(covariance.ldlt().solve(error));
  return out;
}

}  // namespace asperity
