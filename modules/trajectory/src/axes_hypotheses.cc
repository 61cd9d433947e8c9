#include "axes_hypotheses.h"

#include <algorithm>
#include <array>
#include <limits>
#include <vector>

namespace asperity::inertial_smoother {

namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

std::vector<Matrix3d> conventions() {
  std::vector<Matrix3d> out;
  for (int negative = 1; negative < 8; ++negative) {
    Vector3d sign = Vector3d::Ones();
    for (int axis = 0; axis < 3; ++axis) {
      if ((negative >> axis & 1) != 0) sign[axis] = -1.0;
    }
    out.emplace_back(sign.asDiagonal());
  }
  constexpr std::array<std::array<int, 3>, 5> kOrders{{{1, 0, 2}, {0, 2, 1}, {2, 1, 0}, {1, 2, 0}, {2, 0, 1}}};
  for (const auto& order : kOrders) {
    Matrix3d A = Matrix3d::Zero();
    for (int axis = 0; axis < 3; ++axis) A(axis, order[static_cast<std::size_t>(axis)]) = 1.0;
    out.push_back(A);
  }
  return out;
}

// The problem with positions A p about `middle`. The marker's place moves, its rotation stays.
Problem with_axes(const Problem& problem, const Matrix3d& A, const Vector3d& middle_m) {
  Problem out = problem;
  for (std::size_t i = 0; i < out.poses.size(); ++i) {
    out.poses[i].translation_m = middle_m + A * (problem.poses[i].translation_m - middle_m);
    out.pose_noise[i].position_m2 = A * problem.pose_noise[i].position_m2 * A.transpose();
  }
  const Vector3d arm_m = out.start.q * out.start.lever;
  out.start.p = middle_m + A * (problem.start.p - arm_m - middle_m) + arm_m;
  out.start.v = A * problem.start.v;
  out.slow_sigma.head<3>() = A.cwiseAbs() * problem.slow_sigma.head<3>();
  return out;
}

}  // namespace

double best_other_axes(const Problem& problem) {
  Vector3d middle_m = Vector3d::Zero();
  for (const Pose& pose : problem.poses) middle_m += pose.translation_m / static_cast<double>(problem.poses.size());
  const double stated = log_likelihood(problem);
  double best = -std::numeric_limits<double>::infinity();
  for (const Matrix3d& A : conventions()) best = std::max(best, log_likelihood(with_axes(problem, A, middle_m)));
  return best - stated;
}

}  // namespace asperity::inertial_smoother
