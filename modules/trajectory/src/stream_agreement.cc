#include "stream_agreement.h"

#include <cmath>
#include <optional>

#include <Eigen/Cholesky>

#include "axes_hypotheses.h"
#include "symmetric_products.h"

namespace asperity::inertial_smoother {

namespace {

// The effects: the tracker's matrix with the smoothed and with the predicted positions, the latency and its change from
// the first pose to the last, the accelerometer's and the gyroscope's matrix.
constexpr int kSmoothedMatrix = 0, kPredictedMatrix = 9, kLatency = 18, kLatencyChange = 19, kAccel = 20, kGyro = 29,
              kEffects = 38;
using Matrix9d = Eigen::Matrix<double, 9, 9>;
using Vector9d = Eigen::Matrix<double, 9, 1>;

struct NormalEquations {
  Square information = Square::Zero(kEffects, kEffects);
  Eigen::Matrix<double, kEffects, 1> score = Eigen::Matrix<double, kEffects, 1>::Zero();
};

// Nine effects at once, with their covariance; nullopt: the data leave one open.
struct Nine {
  Vector9d value;
  Matrix9d covariance;
};

std::optional<Nine> solve_nine(const NormalEquations& equations, int at) {
  const Eigen::LDLT<Matrix9d> factor(Matrix9d(equations.information.block<9, 9>(at, at)));
  if (factor.info() != Eigen::Success || !(factor.vectorD().minCoeff() > 0.0)) return std::nullopt;
  return Nine{factor.solve(equations.score.segment<9>(at)), factor.solve(Matrix9d::Identity())};
}

// What good calibrations of axes and scales leave, an element. A long scan would else find that, too.
constexpr double kCalibrated = 0.01;

// An element of M that is known to this shows an exchanged or a negative axis, an error of 1 or 2, by itself.
constexpr double kLinear = 0.15;

double normalised_square(Nine nine) {
  nine.covariance.diagonal().array() += kCalibrated * kCalibrated;
  return nine.value.dot(nine.covariance.ldlt().solve(nine.value));
}

NormalEquations sum_effects(const Problem& problem, ForwardRecords& records, const Smoothed& smoothed) {
  const Layout& layout = problem.layout;
  NormalEquations out;
  Vector3d middle_m = Vector3d::Zero();
  for (const Pose& pose : problem.poses) middle_m += pose.translation_m / static_cast<double>(problem.poses.size());
  const double first_s = problem.knots[problem.epochs.front().knot].t;
  const double duration_s = problem.knots[problem.epochs.back().knot].t - first_s;
  // What one unit of each effect leaves in the filter's error state.
  Square X = Square::Zero(layout.size, kEffects);
  if (layout.accel_matrix >= 0) X.block<9, 9>(layout.accel_matrix, kAccel).setIdentity();
  if (layout.gyro_matrix >= 0) X.block<9, 9>(layout.gyro_matrix, kGyro).setIdentity();
  Transition transition;  // to the epoch in hand
  for (std::size_t e = 0; e < records.size(); ++e) {
    if (e > 0) {
      X.topRows<9>() += Transition::times(transition.rows(layout), X, layout);
      if (layout.slow >= 0) X.middleRows<6>(layout.slow) *= transition.slow_decay(problem);
    }
    const Record& record = records.at(e);
    transition = record.transition;
    if (!record.updated) continue;
    const auto i = static_cast<std::size_t>(problem.epochs[e].pose);
    Rows<6> D = record.predicted.times(X, layout);
    const Vector3d from_middle_m = problem.poses[i].translation_m - middle_m;
    const Vector3d smoothed_m = from_middle_m - smoothed.position_residual[i];
    const Vector3d predicted_m = from_middle_m - record.predicted.residual.head<3>();
    for (int axis = 0; axis < 3; ++axis) {
      D.block<3, 3>(0, kSmoothedMatrix + 3 * axis).diagonal().array() += smoothed_m[axis];
      D.block<3, 3>(0, kPredictedMatrix + 3 * axis).diagonal().array() += predicted_m[axis];
    }
    D.col(kLatency) -= record.predicted.rate;
    const double share = (problem.knots[problem.epochs[e].knot].t - first_s) / duration_s - 0.5;
    D.col(kLatencyChange) -= share * record.predicted.rate;
    if (record.believed) {
      const Rows<6> weighted = record.S_inverse.lazyProduct(D);
      add_transposed_product<6>(1.0, D, weighted, out.information);
      out.score += weighted.transpose().lazyProduct(record.predicted.residual);
    }
    const Rows<6> HP = record.predicted.times(record.covariance(layout.size), layout);
    add_product<6>(-1.0, HP, record.N_inverse.lazyProduct(D), X);
  }
  return out;
}

struct Estimate {
  double value = StreamAgreement::kUnknown;
  double sigma = StreamAgreement::kUnknown;
};

// Of the sum of effects with the weights `a`.
Estimate one_effect(const NormalEquations& equations, int at, const Vector9d& a) {
  const double information = a.dot(equations.information.block<9, 9>(at, at) * a);
  if (!(information > 0.0)) return {};
  return {a.dot(equations.score.segment<9>(at)) / information, 1.0 / std::sqrt(information)};
}

// The second of two effects whose first is free.
Estimate beside(const NormalEquations& equations, int first, int second) {
  const double a = equations.information(first, first), b = equations.information(first, second);
  const double information = equations.information(second, second) - (a > 0.0 ? b * b / a : 0.0);
  if (!(information > 1e-9 * equations.information(second, second))) return {};
  const double score = equations.score[second] - (a > 0.0 ? b / a * equations.score[first] : 0.0);
  return {score / information, 1.0 / std::sqrt(information)};
}

}  // namespace

StreamAgreement compare_streams(const Problem& problem, ForwardRecords& records, const Smoothed& smoothed) {
  const NormalEquations equations = sum_effects(problem, records, smoothed);
  StreamAgreement out;
  const Vector9d diagonal = Matrix3d::Identity().reshaped(9, 1);
  const Estimate upper = one_effect(equations, kSmoothedMatrix, diagonal);
  const Estimate lower = one_effect(equations, kPredictedMatrix, diagonal);
  out.scale = 0.5 * (upper.value + lower.value);
  out.scale_sigma = std::hypot(std::max(upper.sigma, lower.sigma), 0.5 * (upper.value - lower.value));
  bool known = false;
  const std::optional<Nine> high = solve_nine(equations, kSmoothedMatrix),
                            low = solve_nine(equations, kPredictedMatrix);
  if (high && low) {
    const Vector9d half = 0.5 * (high->value - low->value);
    const Vector9d variance = 0.5 * (high->covariance + low->covariance).diagonal() + half.cwiseAbs2();
    known = std::sqrt(variance.maxCoeff()) < kLinear;
    out.axes_chi2 = normalised_square(
        {0.5 * (high->value + low->value), 0.5 * (high->covariance + low->covariance) + half * half.transpose()});
  }
  if (!known && problem.restarts.empty()) out.other_axes_log_ratio = best_other_axes(problem);
  if (equations.information(kLatency, kLatency) > 0.0) {
    out.latency_s = equations.score[kLatency] / equations.information(kLatency, kLatency);
    out.latency_sigma_s = 1.0 / std::sqrt(equations.information(kLatency, kLatency));
  }
  const Estimate change = beside(equations, kLatency, kLatencyChange);
  out.latency_change_s = change.value;
  out.latency_change_sigma_s = change.sigma;
  const auto matrix_chi2 = [&](int in_state, int at) {
    const std::optional<Nine> nine = in_state >= 0 ? solve_nine(equations, at) : std::nullopt;
    return nine ? normalised_square(*nine) : StreamAgreement::kUnknown;
  };
  out.accel_axes_chi2 = matrix_chi2(problem.layout.accel_matrix, kAccel);
  out.gyro_axes_chi2 = matrix_chi2(problem.layout.gyro_matrix, kGyro);
  return out;
}

}  // namespace asperity::inertial_smoother
