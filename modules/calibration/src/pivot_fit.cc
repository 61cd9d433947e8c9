#include "pivot_fit.h"

#include <cmath>

#include <Eigen/Cholesky>
#include <Eigen/LU>

#include "asperity/algebra/solve.h"
#include "asperity/geometry/pose.h"

namespace asperity {

namespace {

using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;
using Design = Eigen::Matrix<double, 3, 6>;

Eigen::Matrix3d miss_covariance(const Eigen::Vector3d& arm_m, const TrackerCalibration& tracker) {
  const Eigen::Matrix3d lever = skew(arm_m);
  return Eigen::Matrix3d(tracker.sigma_position_m.cwiseAbs2().asDiagonal()) +
         lever * tracker.sigma_rotation_rad.cwiseAbs2().asDiagonal() * lever.transpose();
}

// E([φ]×ᵀ W [φ]×) for the stated rotation noise.
Eigen::Matrix3d rotated_weight(const Eigen::Matrix3d& W, const TrackerCalibration& tracker) {
  Eigen::Matrix3d out = Eigen::Matrix3d::Zero();
  for (int axis = 0; axis < 3; ++axis) {
    const Eigen::Matrix3d turn = tracker.sigma_rotation_rad[axis] * skew(Eigen::Vector3d::Unit(axis));
    out += turn.transpose() * W * turn;
  }
  return out;
}

// Sums over the poses at one set of weights.
struct Normal {
  Matrix6 A = Matrix6::Zero();
  Matrix6 excess = Matrix6::Zero();  // what the stated rotation noise adds to A
  Vector6 b = Vector6::Zero();
  double count = 0.0;
};

template <class Visit>
void for_each(const std::vector<RowRun>& runs, Visit visit) {
  for (const RowRun& run : runs) {
    for (std::size_t i = run.first; i < run.last; ++i) visit(i);
  }
}

Design pivot_design(const Eigen::Matrix3d& R) {
  Design G;
  G << R, -Eigen::Matrix3d::Identity();
  return G;
}

Normal sum_normals(const PivotPoses& poses, const std::vector<RowRun>& runs, const Pivot& at,
                   const TrackerCalibration& tracker) {
  Normal out;
  for_each(runs, [&](std::size_t i) {
    const Eigen::Matrix3d& R = poses.R[i];
    const Eigen::Matrix3d W = miss_covariance(R * at.tip_m, tracker).inverse();
    const Design G = pivot_design(R);
    const Eigen::Matrix<double, 6, 3> GW = G.transpose() * W;
    out.A += GW * G;
    out.b -= GW * poses.p_m[i];
    out.excess.topLeftCorner<3, 3>() += R.transpose() * rotated_weight(W, tracker) * R;
    out.count += 1.0;
  });
  return out;
}

}  // namespace

Pivot solve_pivot(const PivotPoses& poses, const std::vector<std::size_t>& places) {
  const auto rows = static_cast<Eigen::Index>(3 * places.size());
  // About one pose's place, so that a far world origin costs no digits.
  const Eigen::Vector3d origin_m = poses.p_m[places.front()];
  Eigen::MatrixXd G(rows, 6);
  Eigen::VectorXd y(rows);
  for (std::size_t k = 0; k < places.size(); ++k) {
    const auto row = static_cast<Eigen::Index>(3 * k);
    G.middleRows<3>(row) = pivot_design(poses.R[places[k]]);
    y.segment<3>(row) = origin_m - poses.p_m[places[k]];
  }
  const Vector6 solved = least_squares(G, y).x;
  return {solved.head<3>(), solved.tail<3>() + origin_m};
}

double pivot_distance(const Pivot& pivot, const PivotPoses& poses, std::size_t i, const TrackerCalibration& tracker) {
  const Eigen::Vector3d miss_m = pivot.miss_m(poses, i);
  return std::sqrt(miss_m.dot(miss_covariance(poses.R[i] * pivot.tip_m, tracker).ldlt().solve(miss_m)));
}

PivotFit fit_pivot(const PivotPoses& poses, const std::vector<RowRun>& runs, const Pivot& start,
                   const TrackerCalibration& tracker) {
  PivotFit out;
  out.pivot = start;
  Matrix6 A = Matrix6::Identity();
  Matrix6 excess = Matrix6::Zero();
  double count = 0.0;
  constexpr int kRounds = 20;
  for (int round = 0; round < kRounds; ++round) {
    double chi = 0.0;
    for_each(runs, [&](std::size_t i) { chi += std::pow(pivot_distance(out.pivot, poses, i, tracker), 2); });
    const Normal normal = sum_normals(poses, runs, out.pivot, tracker);
    count = normal.count;
    out.noise_ratio = std::sqrt(chi / (3.0 * count - 6.0));
    excess = out.noise_ratio * out.noise_ratio * normal.excess;
    A = normal.A - excess;
    const Vector6 solved = solve_symmetric(A, normal.b);
    const Pivot next{solved.head<3>(), solved.tail<3>()};
    const double step_m = (next.tip_m - out.pivot.tip_m).norm() + (next.dimple_m - out.pivot.dimple_m).norm();
    out.pivot = next;
    if (step_m <= 1e-9 * (next.tip_m.norm() + next.dimple_m.norm())) break;
  }

  Vector6 theta;
  theta << out.pivot.tip_m, out.pivot.dimple_m;
  const Vector6 taken = excess * theta / count;
  Eigen::MatrixXd scores = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(poses.size()), 6);
  double square = 0.0;
  double expected = 0.0;
  for_each(runs, [&](std::size_t i) {
    const Eigen::Vector3d miss_m = out.pivot.miss_m(poses, i);
    const Eigen::Matrix3d sigma = miss_covariance(poses.R[i] * out.pivot.tip_m, tracker);
    scores.row(static_cast<Eigen::Index>(i)) =
        (pivot_design(poses.R[i]).transpose() * sigma.ldlt().solve(miss_m) - taken).transpose();
    square += miss_m.squaredNorm();
    expected += sigma.trace();
  });
  out.rms_m = std::sqrt(square / count);
  out.expected_rms_m = std::sqrt(expected / count);
  const Matrix6 inverse = inverse_of(A);
  // What each pose moves the result by.
  scores *= inverse;
  out.covariance = count * long_run_covariance(scores, runs, 6.0 / (3.0 * count));
  out.independent_covariance = out.noise_ratio * out.noise_ratio * inverse;
  return out;
}

}  // namespace asperity
