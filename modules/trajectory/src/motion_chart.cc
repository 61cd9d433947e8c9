#include "motion_chart.h"

#include <cmath>

#include <Eigen/Cholesky>
#include <Eigen/LU>

#include "inertial_smoother.h"

namespace asperity::motion_chart {

namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Square6 = Eigen::Matrix<double, 6, 6>;
using Vector6 = Eigen::Matrix<double, 6, 1>;

struct State {
  Pose pose;
  Vector3d rate = Vector3d::Zero();
};

// A body in a hand: the first pose and its rate, before anything is known.
constexpr double kFirst_m = 0.01, kFirst_mps = 1.0, kFirst_rad = 0.3, kFirst_radps = 10.0;

// How far `a` is from `b`, as an error of the value.
Vector3d difference(ChartKind kind, const Pose& a, const Pose& b) {
  return kind == ChartKind::kPosition ? Vector3d(a.translation_m - b.translation_m)
                                      : log_rotation(a.rotation * b.rotation.conjugate());
}

void move(ChartKind kind, const Vector3d& by, Pose& pose) {
  if (kind == ChartKind::kPosition) {
    pose.translation_m += by;
  } else {
    pose.rotation = (exp_rotation(by) * pose.rotation).normalized();
  }
}

Vector6 difference(ChartKind kind, const State& a, const State& b) {
  Vector6 out;
  out << difference(kind, a.pose, b.pose), a.rate - b.rate;
  return out;
}

void correct(ChartKind kind, const Vector6& by, State& state) {
  move(kind, by.head<3>(), state.pose);
  state.rate += by.tail<3>();
}

Square6 transition(ChartKind kind, const State& from, double step_s) {
  Square6 F = Square6::Identity();
  F.topRightCorner<3, 3>() = step_s * Matrix3d::Identity();
  if (kind == ChartKind::kPosition) return F;
  // φ⁺ = exp(ωT) φ + T (I + ½[ωT]×) δω, to second order in ωT.
  const Vector3d turned = step_s * from.rate;
  F.topLeftCorner<3, 3>() = exp_rotation(turned).toRotationMatrix();
  F.topRightCorner<3, 3>() = step_s * (Matrix3d::Identity() + 0.5 * skew(turned));
  return F;
}

State predict(ChartKind kind, State state, double step_s) {
  move(kind, step_s * state.rate, state.pose);
  return state;
}

// Of white acceleration over a step: density·[T³/3, T²/2; T²/2, T] on each axis.
Square6 process_noise(const Vector3d& density, double step_s) {
  const Matrix3d q = density.asDiagonal();
  Square6 Q;
  Q << q * (step_s * step_s * step_s / 3.0), q * (step_s * step_s / 2.0), q * (step_s * step_s / 2.0), q * step_s;
  return Q;
}

Matrix3d scaled(const Matrix3d& variance, const Vector3d& factor) {
  const Vector3d root = factor.cwiseSqrt();
  return root.asDiagonal() * variance * root.asDiagonal();
}

void make_symmetric(Square6& P) { P = (0.5 * (P + P.transpose())).eval(); }

}  // namespace

Path smooth(ChartKind kind, const Measured& measured, const Vector3d& density, const Vector3d& noise_factor,
            const std::vector<double>& weight, double gate_chi2) {
  const std::size_t n = measured.t_s.size();
  std::vector<State> predicted(n), filtered(n);
  std::vector<Square6> predicted_P(n), filtered_P(n), F(n, Square6::Identity());
  State x{measured.poses[measured.first], Vector3d::Zero()};
  const bool turns = kind == ChartKind::kRotation;
  Vector6 first;
  first << Vector3d::Constant(turns ? kFirst_rad : kFirst_m), Vector3d::Constant(turns ? kFirst_radps : kFirst_mps);
  Square6 P = first.cwiseAbs2().asDiagonal();
  for (std::size_t i = 0; i < n; ++i) {
    if (i > 0) {
      const double step_s = measured.t_s[i] - measured.t_s[i - 1];
      F[i - 1] = transition(kind, x, step_s);
      x = predict(kind, x, step_s);
      P = F[i - 1] * P * F[i - 1].transpose() + process_noise(density, step_s);
      make_symmetric(P);
    }
    predicted[i] = x;
    predicted_P[i] = P;
    const Vector3d innovation = difference(kind, measured.poses[i], x.pose);
    Matrix3d noise = scaled(measured.variance[i], noise_factor) / std::max(weight[i], 1e-12);
    if (gate_chi2 > 0.0) {
      const Matrix3d S = P.topLeftCorner<3, 3>() + noise;
      noise /= std::max(1e-12, inertial_smoother::redescending(innovation.dot(S.ldlt().solve(innovation)), gate_chi2));
    }
    const Matrix3d S = P.topLeftCorner<3, 3>() + noise;
    const Eigen::Matrix<double, 6, 3> K = S.ldlt().solve(P.topRows<3>()).transpose();
    correct(kind, K * innovation, x);
    Square6 keep = Square6::Identity();
    keep.leftCols<3>() -= K;
    P = keep * P * keep.transpose() + K * noise * K.transpose();
    make_symmetric(P);
    filtered[i] = x;
    filtered_P[i] = P;
  }

  Path out;
  out.pose.resize(n);
  out.knots.resize(n);
  out.chi2.resize(n);
  State smoothed = filtered.back();
  Square6 smoothed_P = filtered_P.back();
  for (std::size_t i = n; i-- > 0;) {
    if (i + 1 < n) {
      const Square6 gain = predicted_P[i + 1].ldlt().solve(F[i] * filtered_P[i]).transpose();
      const Vector6 ahead = difference(kind, smoothed, predicted[i + 1]);
      out.knots[i].with_next = gain * smoothed_P;
      smoothed = filtered[i];
      correct(kind, gain * ahead, smoothed);
      smoothed_P = filtered_P[i] + gain * (smoothed_P - predicted_P[i + 1]) * gain.transpose();
      make_symmetric(smoothed_P);
    }
    out.pose[i] = smoothed.pose;
    out.knots[i].rate = smoothed.rate;
    out.knots[i].covariance = smoothed_P;
    const Vector3d residual = difference(kind, measured.poses[i], smoothed.pose);
    out.chi2[i] = residual.dot(scaled(measured.variance[i], noise_factor).ldlt().solve(residual));
  }
  return out;
}

Learnt learn(ChartKind kind, const Measured& measured, const Path& path, const Vector3d& density,
             const Vector3d& noise_factor, const std::vector<double>& weight) {
  Learnt out;
  for (std::size_t i = 0; i < path.knots.size(); ++i) {
    // A pose without weight says nothing.
    const Matrix3d noise = scaled(measured.variance[i], noise_factor) / std::max(weight[i], 1e-12);
    const Vector3d residual = difference(kind, measured.poses[i], path.pose[i]);
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      out.noise_seen[axis] += residual[axis] * residual[axis] / noise(axis, axis);
      out.noise_expected[axis] += 1.0 - std::min(1.0, path.knots[i].covariance(axis, axis) / noise(axis, axis));
    }
    if (i + 1 == path.knots.size()) break;
    const double step_s = measured.t_s[i + 1] - measured.t_s[i];
    const State here{path.pose[i], path.knots[i].rate}, next{path.pose[i + 1], path.knots[i + 1].rate};
    const Square6 F = transition(kind, here, step_s);
    const Vector6 noise_here = difference(kind, next, predict(kind, here, step_s));
    const Square6 mixed = F * path.knots[i].with_next;
    const Square6 noise_P =
        path.knots[i + 1].covariance + F * path.knots[i].covariance * F.transpose() - mixed - mixed.transpose();
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      const Square6 Q = process_noise(density, step_s);
      Eigen::Matrix2d own, found;
      own << Q(axis, axis), Q(axis, axis + 3), Q(axis + 3, axis), Q(axis + 3, axis + 3);
      found << noise_P(axis, axis), noise_P(axis, axis + 3), noise_P(axis + 3, axis), noise_P(axis + 3, axis + 3);
      const Eigen::Vector2d w(noise_here[axis], noise_here[axis + 3]);
      const Eigen::Matrix2d inverse = own.inverse();
      out.density_seen[axis] += w.dot(inverse * w);
      out.density_expected[axis] += std::clamp(2.0 - (inverse * found).trace(), 0.0, 2.0);
    }
  }
  return out;
}

}  // namespace asperity::motion_chart
