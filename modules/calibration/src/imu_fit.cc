#include "imu_fit.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "asperity/base/random.h"
#include "asperity/geometry/pose.h"

namespace asperity {

namespace {

using P = ImuParameters;

constexpr double kPositionPrior_m = 1.0;  // of a hand-held probe
constexpr double kBiasPrior_mps2 = 1.0;
constexpr double kRotationPrior_rad = 1.0;  // about the rotation of the start, which the motion has shown
constexpr double kGyroMatrixPrior = 0.3;    // share of the matrix's size

}  // namespace

ImuFit::ImuFit(SensorSeries accelerometer, SensorSeries gyroscope, PoseSeries poses, ImuMotion motion,
               ImuParameters start, const ImuConfig& config)
    : accelerometer_(std::move(accelerometer)),
      gyroscope_(std::move(gyroscope)),
      poses_(std::move(poses)),
      motion_(std::move(motion)),
      parameters_(std::move(start)),
      given_(parameters_),
      gravity_sigma_(config.gravity_sigma_mps2) {
  noise_.sigma = {1e-3, 1e-3, 1e-3, 5e-3, 5e-3, 5e-3, 0.5, 0.05, 100.0, 100.0};
}

Eigen::VectorXd ImuFit::prior_sigma() const {
  Eigen::VectorXd out = Eigen::VectorXd::Constant(count(), std::numeric_limits<double>::infinity());
  out.segment<3>(P::kRotation).setConstant(kRotationPrior_rad);
  out.segment<3>(P::kPosition).setConstant(kPositionPrior_m);
  out.segment<3>(P::kBias).setConstant(kBiasPrior_mps2);
  out.segment<3>(P::kGravity).setConstant(std::max(1e-6, gravity_sigma_));
  if (has_gyro()) out.segment<9>(P::kGyroMatrix).setConstant(kGyroMatrixPrior * given_.gyro_matrix.norm());
  return out;
}

void ImuFit::visit_pose(std::size_t i, Rows& rows, const std::function<void(const Rows&)>& use) const {
  const double t_s = poses_.t_s[i] - parameters_.latency_s;
  if (!motion_.covers(t_s)) return;
  const ImuMotion::State at = motion_.at(t_s);
  const Pose& pose = poses_.T_world_marker[i];
  const Eigen::Vector3d& arm_m = parameters_.accelerometer_in_marker_m;
  rows.t_s = t_s;
  rows.first_point = at.first_point;
  rows.kind = {ImuNoise::kPosition, ImuNoise::kPosition + 1, ImuNoise::kPosition + 2};
  rows.residual = at.s_m - at.R * arm_m - pose.translation_m;
  rows.global.setZero(3, count());
  rows.global.middleCols<3>(P::kPosition) = -at.R;
  rows.global.col(P::kLatency) = -(at.v_mps - at.R * at.omega_radps.cross(arm_m));
  const Eigen::Matrix3d by_phi = at.R * skew(arm_m) * at.right_jacobian;
  for (std::size_t j = 0; j < at.basis.value.size(); ++j) {
    const auto column = static_cast<Eigen::Index>(6 * j);
    rows.local.middleCols<3>(column) = at.basis.value[j] * Eigen::Matrix3d::Identity();
    rows.local.middleCols<3>(column + 3) = at.basis.value[j] * by_phi;
  }
  use(rows);

  rows.kind = {ImuNoise::kRotation, ImuNoise::kRotation + 1, ImuNoise::kRotation + 2};
  rows.residual = log_rotation(Eigen::Quaterniond(at.R) * pose.rotation.conjugate());
  rows.global.setZero(3, count());
  rows.global.col(P::kLatency) = -at.R * at.omega_radps;
  const Eigen::Matrix3d turn = at.R * at.right_jacobian;
  for (std::size_t j = 0; j < at.basis.value.size(); ++j) {
    const auto column = static_cast<Eigen::Index>(6 * j);
    rows.local.middleCols<3>(column).setZero();
    rows.local.middleCols<3>(column + 3) = at.basis.value[j] * turn;
  }
  use(rows);
}

void ImuFit::visit(const std::function<void(const Rows&)>& use) const {
  Rows rows;
  for (std::size_t i = 0; i < poses_.t_s.size(); ++i) visit_pose(i, rows, use);

  const Eigen::Matrix3d Mt = parameters_.R_marker_sensor.conjugate().toRotationMatrix();
  rows.kind.fill(ImuNoise::kAccelerometer);
  for (std::size_t i = 0; i < accelerometer_.t_s.size(); ++i) {
    if (!motion_.covers(accelerometer_.t_s[i])) continue;
    const ImuMotion::State at = motion_.at(accelerometer_.t_s[i]);
    const Eigen::Vector3d felt = at.R.transpose() * (at.a_mps2 - parameters_.gravity_world_mps2);
    rows.t_s = accelerometer_.t_s[i];
    rows.first_point = at.first_point;
    rows.residual = Mt * felt + parameters_.accel_bias_mps2 - accelerometer_.x[i];
    const Eigen::Matrix3d by_turn = Mt * skew(felt);
    rows.global.setZero(3, count());
    rows.global.middleCols<3>(P::kRotation) = by_turn;
    rows.global.middleCols<3>(P::kBias).setIdentity();
    rows.global.middleCols<3>(P::kGravity) = -Mt * at.R.transpose();
    const Eigen::Matrix3d by_phi = by_turn * at.right_jacobian, by_a = Mt * at.R.transpose();
    for (std::size_t j = 0; j < at.basis.value.size(); ++j) {
      const auto column = static_cast<Eigen::Index>(6 * j);
      rows.local.middleCols<3>(column) = at.basis.second[j] * by_a;
      rows.local.middleCols<3>(column + 3) = at.basis.value[j] * by_phi;
    }
    use(rows);
  }
  rows.kind.fill(ImuNoise::kGyroscope);
  for (std::size_t i = 0; i < gyroscope_.t_s.size(); ++i) {
    if (!motion_.covers(gyroscope_.t_s[i])) continue;
    const ImuMotion::State at = motion_.at(gyroscope_.t_s[i]);
    rows.t_s = gyroscope_.t_s[i];
    rows.first_point = at.first_point;
    rows.residual = parameters_.gyro_matrix * at.omega_radps + parameters_.gyro_bias_radps - gyroscope_.x[i];
    rows.global.setZero(3, count());
    rows.global.middleCols<3>(P::kGyroBias).setIdentity();
    for (int column = 0; column < 3; ++column) {
      rows.global.middleCols<3>(P::kGyroMatrix + 3 * column) = at.omega_radps[column] * Eigen::Matrix3d::Identity();
    }
    const Eigen::Matrix3d by_rate = parameters_.gyro_matrix * at.right_jacobian;
    const Eigen::Matrix3d by_phi = parameters_.gyro_matrix * at.omega_by_phi;
    for (std::size_t j = 0; j < at.basis.value.size(); ++j) {
      const auto column = static_cast<Eigen::Index>(6 * j);
      rows.local.middleCols<3>(column).setZero();
      rows.local.middleCols<3>(column + 3) = at.basis.first[j] * by_rate + at.basis.value[j] * by_phi;
    }
    use(rows);
  }
  // Where nothing is measured, the motion is smooth.
  rows.global.setZero(3, count());
  for (Eigen::Index k = 0; k + ArrowSystem::kSupport <= motion_.points(); ++k) {
    const ImuMotion::Bend bend = motion_.bend(k);
    rows.t_s = bend.t_s;
    rows.first_point = k;
    for (const bool turning : {false, true}) {
      rows.kind.fill(turning ? ImuNoise::kTurning : ImuNoise::kMoving);
      rows.residual = turning ? bend.phi_second : bend.a_mps2;
      rows.local.setZero();
      for (std::size_t j = 0; j < bend.second.size(); ++j) {
        rows.local.middleCols<3>(static_cast<Eigen::Index>(6 * j + (turning ? 3 : 0)))
            .diagonal()
            .setConstant(bend.second[j]);
      }
      use(rows);
    }
  }
}

void ImuFit::whiten(Rows& rows) const {
  for (Eigen::Index row = 0; row < 3; ++row) {
    const double weight = 1.0 / noise_.sigma[rows.kind[static_cast<std::size_t>(row)]];
    rows.residual[row] *= weight;
    rows.local.row(row) *= weight;
    rows.global.row(row) *= weight;
  }
}

ArrowSystem ImuFit::assemble() const {
  ArrowSystem system(motion_.points(), count());
  visit([&](const Rows& given) {
    Rows rows = given;
    whiten(rows);
    system.add(rows.first_point, rows.local, rows.global, rows.residual);
  });
  const Eigen::VectorXd sigma = prior_sigma();
  Eigen::VectorXd off = Eigen::VectorXd::Zero(count());
  off.segment<3>(P::kPosition) = parameters_.accelerometer_in_marker_m;
  off.segment<3>(P::kBias) = parameters_.accel_bias_mps2;
  off.segment<3>(P::kGravity) = parameters_.gravity_world_mps2 - given_.gravity_world_mps2;
  off.segment<3>(P::kRotation) = log_rotation(parameters_.R_marker_sensor * given_.R_marker_sensor.conjugate());
  if (has_gyro()) {
    const Eigen::Matrix3d change = parameters_.gyro_matrix - given_.gyro_matrix;
    off.segment<9>(P::kGyroMatrix) = change.reshaped();
  }
  for (Eigen::Index k = 0; k < count(); ++k) {
    if (std::isfinite(sigma[k])) system.add_prior(k, off[k], 1.0 / (sigma[k] * sigma[k]));
  }
  return system;
}

// σ² = Σ r² / (n − tr H) of each kind, H the part of the hat matrix that is of its rows; the trace by Hutchinson's
// estimator (1989) with fixed signs.
void ImuFit::update_noise(const ArrowSystem& system) {
  constexpr Eigen::Index kKinds = ImuNoise::kKinds;
  constexpr std::uint64_t kSeed = 20;
  Eigen::MatrixXd points = Eigen::MatrixXd::Zero(6 * motion_.points(), kKinds);
  Eigen::MatrixXd parameters = Eigen::MatrixXd::Zero(count(), kKinds);
  Eigen::Matrix<double, kKinds, 1> square = Eigen::Matrix<double, kKinds, 1>::Zero(), rows_of = square, trace = square;
  const auto each_row = [&](const auto& use) {
    Random random(kSeed);
    visit([&](const Rows& given) {
      Rows rows = given;
      whiten(rows);
      for (Eigen::Index row = 0; row < 3; ++row) {
        const auto kind = static_cast<Eigen::Index>(rows.kind[static_cast<std::size_t>(row)]);
        use(rows, row, kind, random.uniform() < 0.5 ? -1.0 : 1.0);
      }
    });
  };
  each_row([&](const Rows& rows, Eigen::Index row, Eigen::Index kind, double sign) {
    points.col(kind).segment(6 * rows.first_point, ArrowSystem::kLocal) += sign * rows.local.row(row).transpose();
    parameters.col(kind) += sign * rows.global.row(row).transpose();
    square[kind] += rows.residual[row] * rows.residual[row];
    rows_of[kind] += 1.0;
  });
  system.solve(points, parameters);
  each_row([&](const Rows& rows, Eigen::Index row, Eigen::Index kind, double sign) {
    trace[kind] +=
        sign * (rows.local.row(row).dot(points.col(kind).segment(6 * rows.first_point, ArrowSystem::kLocal)) +
                rows.global.row(row).dot(parameters.col(kind)));
  });
  for (Eigen::Index kind = 0; kind < kKinds; ++kind) {
    if (rows_of[kind] == 0.0) continue;
    // What the estimator scatters by must not leave a kind without noise, nor with endless noise.
    constexpr double kLeastShare = 0.02, kLeastFactor = 0.1, kMostFactor = 10.0;
    const double freedom = std::max(kLeastShare * rows_of[kind], rows_of[kind] - trace[kind]);
    noise_.sigma[static_cast<std::size_t>(kind)] *=
        std::clamp(std::sqrt(square[kind] / freedom), kLeastFactor, kMostFactor);
  }
}

void ImuFit::step(const Eigen::VectorXd& points, const Eigen::VectorXd& d) {
  motion_.step(points);
  parameters_.R_marker_sensor = (exp_rotation(d.segment<3>(P::kRotation)) * parameters_.R_marker_sensor).normalized();
  parameters_.accelerometer_in_marker_m += d.segment<3>(P::kPosition);
  parameters_.latency_s += d[P::kLatency];
  parameters_.accel_bias_mps2 += d.segment<3>(P::kBias);
  parameters_.gravity_world_mps2 += d.segment<3>(P::kGravity);
  if (!has_gyro()) return;
  parameters_.gyro_bias_radps += d.segment<3>(P::kGyroBias);
  for (int column = 0; column < 3; ++column) {
    parameters_.gyro_matrix.col(column) += d.segment<3>(P::kGyroMatrix + 3 * column);
  }
}

bool ImuFit::run() {
  // The noise is settled after some steps; with it fixed, Gauss–Newton converges.
  constexpr int kMostSteps = 30, kFewest = 4, kNoiseSteps = 12;
  constexpr double kSmall = 0.02;  // of a standard error
  for (int i = 0; i < kMostSteps; ++i) {
    ArrowSystem system = assemble();
    if (!system.factorise()) return false;
    Eigen::VectorXd points, parameters;
    system.solve(points, parameters);
    if (!points.allFinite() || !parameters.allFinite()) return false;
    covariance_ = system.covariance();
    taken_up_ = system.taken_up();
    const double largest = parameters.cwiseAbs().cwiseQuotient(covariance_.diagonal().cwiseSqrt()).maxCoeff();
    step(points, parameters);
    if (i + 1 >= kFewest && largest < kSmall) return true;
    if (i > 0 && i < kNoiseSteps) update_noise(system);
  }
  return false;
}

std::size_t ImuFit::drop_outliers(double sigmas) {
  std::vector<char> off(poses_.t_s.size(), 0);
  Rows rows;
  for (std::size_t i = 0; i < poses_.t_s.size(); ++i) {
    visit_pose(i, rows, [&](const Rows& given) {
      for (Eigen::Index row = 0; row < 3; ++row) {
        const double sigma = noise_.sigma[given.kind[static_cast<std::size_t>(row)]];
        if (std::abs(given.residual[row]) > sigmas * sigma) off[i] = 1;
      }
    });
  }
  PoseSeries kept;
  for (std::size_t i = 0; i < off.size(); ++i) {
    if (off[i] != 0) continue;
    kept.t_s.push_back(poses_.t_s[i]);
    kept.T_world_marker.push_back(poses_.T_world_marker[i]);
    kept.starts.push_back(poses_.starts[i]);
  }
  const std::size_t dropped = poses_.t_s.size() - kept.t_s.size();
  poses_ = std::move(kept);
  return dropped;
}

ImuFit::Dispersion ImuFit::dispersion() const {
  struct Second {
    Eigen::VectorXd gradient;
    Eigen::MatrixXd information;
  };
  std::vector<Second> seconds;
  const double first_s = poses_.t_s.front() - parameters_.latency_s - 1.0;
  visit([&](const Rows& given) {
    Rows rows = given;
    whiten(rows);
    const auto index = static_cast<std::size_t>(std::max(0.0, rows.t_s - first_s));
    while (seconds.size() <= index) {
      seconds.push_back({Eigen::VectorXd::Zero(count()), Eigen::MatrixXd::Zero(count(), count())});
    }
    // What the motion does not take up.
    const Eigen::MatrixXd J =
        rows.global - rows.local * taken_up_.middleRows(6 * rows.first_point, ArrowSystem::kLocal);
    seconds[index].gradient += J.transpose() * rows.residual;
    seconds[index].information += J.transpose() * J;
  });
  double sum = 0.0, freedom = 0.0, squares = 0.0;
  for (const Second& second : seconds) {
    sum += second.gradient.dot(covariance_ * second.gradient);
    const Eigen::MatrixXd H = covariance_ * second.information;
    freedom += H.trace() - (H * H).trace();
    squares += (H * H).trace();
  }
  if (!(freedom > 0.0)) return {};
  return {sum / freedom, std::sqrt(2.0 * squares) / freedom};
}

}  // namespace asperity
