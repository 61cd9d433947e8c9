#include "inertial_model.h"

#include <algorithm>
#include <cmath>

#include "symmetric_products.h"

namespace asperity::inertial_smoother {

Mounting mounting_of(const Nominal& x, const Problem& problem) {
  const Matrix3d M = x.misalignment.toRotationMatrix();
  const Matrix3d G = problem.gyro_turns_too ? M : Matrix3d(Matrix3d::Identity());
  return {M + x.accel_matrix * M, G + x.gyro_matrix * G, problem.gravity + x.gravity};
}

double accel_density(const Knot& knot, const Problem& problem) {
  const Factors& factors = problem.factors;
  return problem.process_scale * (factors[kAccelOwn] * knot.accel_psd[0] + factors[kAccelMotion] * knot.accel_psd[1] +
                                  factors[kAccelJitter] * knot.accel_psd[2]);
}

double fast_density_factor(const Problem& problem) { return problem.process_scale * problem.factors[kAccelFast]; }

Matrix3d symmetric(const Eigen::Matrix<double, 6, 1>& e) {
  return (Matrix3d() << e[0], e[3], e[4], e[3], e[1], e[5], e[4], e[5], e[2]).finished();
}

double gyro_density(const Knot& knot, const Problem& problem) {
  return problem.factors[kGyroOwn] * knot.gyro_psd[0] + problem.factors[kGyroMotion] * knot.gyro_psd[1];
}

double rate_walk_density(const Problem& problem) { return problem.factors[kRateWalk] * problem.gyro_bias_psd; }

Step advance_state(Nominal& x, const Knot& k0, const Knot& k1, const Mounting& mounting, const Noise& noise) {
  const double dt = k1.t - k0.t;
  Step step;
  step.R0 = x.q.toRotationMatrix();
  step.omega0 = mounting.gyro * k0.w - x.bg;
  step.w = mounting.gyro * (0.5 * (k0.w + k1.w));
  const Vector3d A0 = step.R0 * (mounting.accel * k0.f - x.ba);
  x.q = (x.q * exp_rotation((step.w - x.bg) * dt)).normalized();
  const Vector3d A1 = x.q * (mounting.accel * k1.f - x.ba);
  step.A = 0.5 * (A0 + A1);
  step.a0 = A0 + mounting.gravity;
  x.p += dt * x.v + dt * dt * ((2.0 * A0 + A1) / 6.0 + 0.5 * mounting.gravity) + 0.5 * dt * noise.dv;
  x.v += dt * (step.A + mounting.gravity) + noise.dv;
  x.q = exp_rotation(noise.dphi) * x.q;
  x.bg += noise.dbg;
  return step;
}

void Transition::extend(const Step& s, const Knot& k0, const Knot& k1, const Mounting& mounting,
                        const Problem& problem) {
  const double dt = k1.t - k0.t;
  const double half = 0.5 * dt * dt;
  const Layout& layout = problem.layout;
  const Matrix3d A = skew(s.A);
  if (layout.misalignment >= 0) {
    const Vector3d f_marker = mounting.accel * (0.5 * (k0.f + k1.f));
    const Matrix3d force = -(s.R0 * skew(f_marker)) - A * phimu;
    pmu += dt * vmu + half * force;
    vmu += dt * force;
    if (problem.gyro_turns_too) phimu -= dt * s.R0 * skew(s.w);
  }
  if (layout.accel_matrix >= 0) {
    const Vector3d f_marker = mounting.accel * (0.5 * (k0.f + k1.f));
    pEa += dt * vEa;
    for (int axis = 0; axis < 3; ++axis) {
      const Matrix3d force = f_marker[axis] * s.R0;
      pEa.middleCols<3>(3 * axis) += half * force;
      vEa.middleCols<3>(3 * axis) += dt * force;
    }
  }
  if (layout.gyro_matrix >= 0) {
    Matrix39d turned;
    for (int axis = 0; axis < 3; ++axis) turned.middleCols<3>(3 * axis) = (0.5 * dt * s.w[axis]) * s.R0;
    const Matrix39d leak = -(A * (phiEg + turned));
    pEg += dt * vEg + half * leak;
    vEg += dt * leak;
    phiEg += 2.0 * turned;
  }
  const Matrix3d leak = A * (g1 + 0.5 * dt * s.R0);
  pbg += dt * vbg + half * leak;
  vbg += dt * leak;
  g2 += dt * g1 + half * s.R0;
  g1 += dt * s.R0;
  sp += dt * sv + half * s.A;
  sv += dt * s.A;
  for (std::size_t c = 0; c < accel.size(); ++c) accel[c].add(k0.accel_psd[c] * dt, dt);
  fast.add(dt * k0.accel_fast.cast<double>(), dt);
  marker_from_sensor = mounting.accel;
  for (std::size_t c = 0; c < turn.size(); ++c) turn[c] += k0.gyro_psd[c] * dt;
  T += dt;
}

TopRows Transition::rows(const Layout& layout) const {
  TopRows U = TopRows::Zero(9, layout.size);
  U.block<3, 3>(kP, kV).diagonal().setConstant(T);
  U.block<3, 3>(kP, kPhi) = -skew(sp);
  U.block<3, 3>(kP, kBa) = -g2;
  U.block<3, 3>(kP, kBg) = pbg;
  U.block<3, 3>(kV, kPhi) = -skew(sv);
  U.block<3, 3>(kV, kBa) = -g1;
  U.block<3, 3>(kV, kBg) = vbg;
  U.block<3, 3>(kPhi, kBg) = -g1;
  if (layout.misalignment >= 0) {
    U.block<3, 3>(kP, layout.misalignment) = pmu;
    U.block<3, 3>(kV, layout.misalignment) = vmu;
    U.block<3, 3>(kPhi, layout.misalignment) = phimu;
  }
  if (layout.accel_matrix >= 0) {
    U.block<3, 9>(kP, layout.accel_matrix) = pEa;
    U.block<3, 9>(kV, layout.accel_matrix) = vEa;
  }
  if (layout.gyro_matrix >= 0) {
    U.block<3, 9>(kP, layout.gyro_matrix) = pEg;
    U.block<3, 9>(kV, layout.gyro_matrix) = vEg;
    U.block<3, 9>(kPhi, layout.gyro_matrix) = phiEg;
  }
  if (layout.gravity >= 0) {
    U.block<3, 3>(kP, layout.gravity).diagonal().setConstant(0.5 * T * T);
    U.block<3, 3>(kV, layout.gravity).diagonal().setConstant(T);
  }
  return U;
}

namespace {

// U P; most columns of U that are zero are left out.
TopRows times_covariance(const TopRows& U, const Layout& layout, const Square& P) {
  int last = layout.slow >= 0 ? layout.slow : layout.size;
  int first = last;
  for (const int at : {layout.misalignment, layout.accel_matrix, layout.gyro_matrix, layout.gravity}) {
    if (at >= 0) first = std::min(first, at);
  }
  return times_symmetric<9>(U, P, {kV, kBase, first, last});
}

}  // namespace

double Transition::slow_decay(const Problem& problem) const { return std::exp(-T / problem.slow_time_s); }

Vector6d Transition::slow_noise(const Problem& problem) const {
  Vector6d out = (1.0 - std::pow(slow_decay(problem), 2)) * problem.slow_sigma.cwiseAbs2();
  out.head<3>() *= problem.factors[kSlow];
  out.tail<3>() *= problem.factors[kSlowTurn];
  return out;
}

Transition::Fast Transition::fast_noise(const Problem& problem) const {
  if (!(T > 0.0)) return {Matrix3d::Zero(), Matrix3d::Zero(), Matrix3d::Zero()};
  const double factor = fast_density_factor(problem);
  const Matrix3d world = g1 / T * marker_from_sensor;
  const auto turned = [&](const Eigen::Matrix<double, 6, 1>& elements) -> Matrix3d {
    return factor * (world * symmetric(elements) * world.transpose());
  };
  return {turned(fast.pp), turned(fast.pv), turned(fast.vv)};
}

void Transition::propagate(const Problem& problem, const TopRows& U, Nominal& x, Square& P) const {
  const Layout& layout = problem.layout;
  const TopRows UP = times_covariance(U, layout, P);
  const Eigen::Matrix<double, 9, 9> UPU = UP * U.transpose();
  P.topRows(9) += UP;
  P.leftCols(9) += UP.transpose();
  P.topLeftCorner<9, 9>() += UPU;
  if (layout.slow >= 0) {
    const double keep = slow_decay(problem);
    x.slow *= keep;
    P.middleRows<6>(layout.slow) *= keep;
    P.middleCols<6>(layout.slow) *= keep;
    P.diagonal().segment<6>(layout.slow) += slow_noise(problem);
  }
  NoiseIntegral q;
  constexpr std::array<Component, 3> kAccel{kAccelOwn, kAccelMotion, kAccelJitter};
  for (std::size_t c = 0; c < accel.size(); ++c) {
    const double factor = problem.process_scale * problem.factors[kAccel[c]];
    q.pp += factor * accel[c].pp;
    q.pv += factor * accel[c].pv;
    q.vv += factor * accel[c].vv;
  }
  const double qphi = problem.factors[kGyroOwn] * turn[0] + problem.factors[kGyroMotion] * turn[1];
  const double rate = rate_walk_density(problem);
  const Matrix3d mean_R = T > 0.0 ? Matrix3d(g1 / T) : Matrix3d::Identity();
  P.block<3, 3>(kP, kP).diagonal().array() += q.pp;
  P.block<3, 3>(kP, kV).diagonal().array() += q.pv;
  P.block<3, 3>(kV, kP).diagonal().array() += q.pv;
  P.block<3, 3>(kV, kV).diagonal().array() += q.vv;
  const Fast uneven = fast_noise(problem);
  P.block<3, 3>(kP, kP) += uneven.pp;
  P.block<3, 3>(kP, kV) += uneven.pv;
  P.block<3, 3>(kV, kP) += uneven.pv;
  P.block<3, 3>(kV, kV) += uneven.vv;
  P.block<3, 3>(kPhi, kPhi).diagonal().array() += qphi + rate * T * T * T / 3.0;
  P.block<3, 3>(kPhi, kBg) -= 0.5 * rate * T * T * mean_R;
  P.block<3, 3>(kBg, kPhi) -= 0.5 * rate * T * T * mean_R.transpose();
  P.block<3, 3>(kBg, kBg).diagonal().array() += rate * T;
  P.block<3, 3>(kBa, kBa).diagonal().array() += problem.factors[kAccelWalk] * problem.accel_bias_psd * T;
}

void Transition::propagate_back(const Problem& problem, const TopRows& U, State& lambda, Square& Lambda) const {
  lambda += (U.transpose() * lambda.head(9)).eval();
  // With W = (Λ + Λ₉₉ U / 2) of the upper rows both outer terms are Uᵀ W and its transpose.
  Rows<18> A(18, Lambda.cols()), B(18, Lambda.cols());
  const Eigen::Matrix<double, 9, 9> half = 0.5 * Lambda.topLeftCorner<9, 9>();
  for (Eigen::Index c = 0; c < Lambda.cols(); ++c) {
    B.col(c).head<9>() = Lambda.col(c).head<9>() + half * U.col(c);
  }
  A.topRows<9>() = U;
  A.bottomRows<9>() = B.topRows<9>();
  B.bottomRows<9>() = U;
  add_transposed_product<18>(1.0, A, B, Lambda);
  if (problem.layout.slow >= 0) {
    const double keep = slow_decay(problem);
    lambda.segment<6>(problem.layout.slow) *= keep;
    Lambda.middleRows<6>(problem.layout.slow) *= keep;
    Lambda.middleCols<6>(problem.layout.slow) *= keep;
  }
}

void Transition::add_score(const Problem& problem, const State& lambda, const Square& Lambda, NoiseScore& score) const {
  const auto lp = lambda.segment<3>(kP), lv = lambda.segment<3>(kV), lphi = lambda.segment<3>(kPhi),
             lbg = lambda.segment<3>(kBg), lba = lambda.segment<3>(kBa);
  const double seen_pp = lp.squaredNorm(), seen_pv = lp.dot(lv), seen_vv = lv.squaredNorm();
  const double mean_pp = Lambda.block<3, 3>(kP, kP).trace(), mean_pv = Lambda.block<3, 3>(kP, kV).trace(),
               mean_vv = Lambda.block<3, 3>(kV, kV).trace();
  constexpr std::array<Component, 3> kAccel{kAccelOwn, kAccelMotion, kAccelJitter};
  for (std::size_t c = 0; c < accel.size(); ++c) {
    const double factor = problem.process_scale * problem.factors[kAccel[c]];
    score.add(kAccel[c], factor * (accel[c].pp * seen_pp + 2.0 * accel[c].pv * seen_pv + accel[c].vv * seen_vv),
              factor * (accel[c].pp * mean_pp + 2.0 * accel[c].pv * mean_pv + accel[c].vv * mean_vv));
  }
  const Fast uneven = fast_noise(problem);
  score.add(kAccelFast, lp.dot(uneven.pp * lp) + 2.0 * lp.dot(uneven.pv * lv) + lv.dot(uneven.vv * lv),
            uneven.pp.cwiseProduct(Lambda.block<3, 3>(kP, kP)).sum() +
                2.0 * uneven.pv.cwiseProduct(Lambda.block<3, 3>(kP, kV)).sum() +
                uneven.vv.cwiseProduct(Lambda.block<3, 3>(kV, kV)).sum());
  const double seen_phi = lphi.squaredNorm();
  const double mean_phi = Lambda.block<3, 3>(kPhi, kPhi).trace();
  score.add(kGyroOwn, problem.factors[kGyroOwn] * turn[0] * seen_phi, problem.factors[kGyroOwn] * turn[0] * mean_phi);
  score.add(kGyroMotion, problem.factors[kGyroMotion] * turn[1] * seen_phi,
            problem.factors[kGyroMotion] * turn[1] * mean_phi);
  const double rate = rate_walk_density(problem);
  const Matrix3d mean_R = T > 0.0 ? Matrix3d(g1 / T) : Matrix3d::Identity();
  score.add(kRateWalk, rate * (T * T * T / 3.0 * seen_phi - T * T * lphi.dot(mean_R * lbg) + T * lbg.squaredNorm()),
            rate * (T * T * T / 3.0 * mean_phi - T * T * (mean_R.transpose() * Lambda.block<3, 3>(kPhi, kBg)).trace() +
                    T * Lambda.block<3, 3>(kBg, kBg).trace()));
  const double walk = problem.factors[kAccelWalk] * problem.accel_bias_psd * T;
  score.add(kAccelWalk, walk * lba.squaredNorm(), walk * Lambda.block<3, 3>(kBa, kBa).trace());
  if (problem.layout.slow >= 0) {
    const int at = problem.layout.slow;
    const Vector6d q = slow_noise(problem);
    const Vector6d seen = q.cwiseProduct(lambda.segment<6>(at).cwiseAbs2());
    const Vector6d expected = q.cwiseProduct(Lambda.diagonal().segment<6>(at));
    score.add(kSlow, seen.head<3>().sum(), expected.head<3>().sum());
    score.add(kSlowTurn, seen.tail<3>().sum(), expected.tail<3>().sum());
  }
}

void apply_correction(const State& d, const Layout& layout, Nominal& x) {
  x.p += d.segment<3>(kP);
  x.v += d.segment<3>(kV);
  x.q = (exp_rotation(d.segment<3>(kPhi)) * x.q).normalized();
  x.ba += d.segment<3>(kBa);
  x.bg += d.segment<3>(kBg);
  if (layout.latency >= 0) x.latency += d[layout.latency];
  if (layout.lever >= 0) x.lever += d.segment<3>(layout.lever);
  if (layout.misalignment >= 0) {
    x.misalignment = (exp_rotation(d.segment<3>(layout.misalignment)) * x.misalignment).normalized();
  }
  if (layout.accel_matrix >= 0) x.accel_matrix += d.segment<9>(layout.accel_matrix).reshaped(3, 3);
  if (layout.gyro_matrix >= 0) x.gyro_matrix += d.segment<9>(layout.gyro_matrix).reshaped(3, 3);
  if (layout.gravity >= 0) x.gravity += d.segment<3>(layout.gravity);
  if (layout.slow >= 0) x.slow += d.segment<6>(layout.slow);
}

Predicted predict_pose(const Nominal& x, const Vector3d& omega, const Pose& pose) {
  Predicted out;
  out.R = x.q.toRotationMatrix();
  out.arm = out.R * x.lever;
  const Vector3d omega_world = out.R * omega;
  const Vector3d v_marker = x.v - omega_world.cross(out.arm);
  out.rate << v_marker, omega_world;
  out.residual.head<3>() = pose.translation_m - (x.p - out.arm - v_marker * x.latency + x.slow.head<3>());
  out.residual.tail<3>() = log_rotation(pose.rotation * x.q.conjugate()) + omega_world * x.latency - x.slow.tail<3>();
  return out;
}

Jacobian Predicted::jacobian(const Layout& layout) const {
  Jacobian H = Jacobian::Zero(6, layout.size);
  H.block<3, 3>(0, kP).setIdentity();
  H.block<3, 3>(0, kPhi) = skew(arm);
  H.block<3, 3>(3, kPhi).setIdentity();
  if (layout.latency >= 0) H.col(layout.latency) = -rate;
  if (layout.lever >= 0) H.block<3, 3>(0, layout.lever) = -R;
  if (layout.slow >= 0) H.block<6, 6>(0, layout.slow).setIdentity();
  return H;
}

Jacobian Predicted::times(const Square& P, const Layout& layout) const {
  Jacobian out(6, P.cols());
  const Matrix3d turn = skew(arm);
  out.topRows<3>() = P.middleRows<3>(kP) + turn * P.middleRows<3>(kPhi);
  out.bottomRows<3>() = P.middleRows<3>(kPhi);
  if (layout.latency >= 0) out -= rate * P.row(layout.latency);
  if (layout.lever >= 0) out.topRows<3>() -= R * P.middleRows<3>(layout.lever);
  if (layout.slow >= 0) out += P.middleRows<6>(layout.slow);
  return out;
}

MeasurementNoise measurement_noise(const Problem& problem, std::size_t pose, const Vector6d& rate) {
  const Factors& factors = problem.factors;
  const Vector3d position(std::sqrt(factors[kPositionX]), std::sqrt(factors[kPositionY]),
                          std::sqrt(factors[kPositionZ]));
  const Vector3d rotation(std::sqrt(factors[kRotationX]), std::sqrt(factors[kRotationY]),
                          std::sqrt(factors[kRotationZ]));
  const PoseNoise& stated = problem.pose_noise[pose];
  return {position.asDiagonal() * stated.position_m2 * position.asDiagonal(),
          rotation.asDiagonal() * stated.rotation_rad2 * rotation.asDiagonal(),
          std::sqrt(factors[kPoseTime]) * problem.time_sigma * rate};
}

Matrix6d MeasurementNoise::covariance(double position_weight, double rotation_weight) const {
  Matrix6d out = timing * timing.transpose();
  out.topLeftCorner<3, 3>() += position;
  out.bottomRightCorner<3, 3>() += rotation;
  // A pose that is not believed may be off in any way: what ties its position to its orientation goes too.
  const double wp = std::max(position_weight, 1e-9), wr = std::max(rotation_weight, 1e-9);
  const double tie = 1.0 / std::sqrt(wp * wr);
  out.topLeftCorner<3, 3>() /= wp;
  out.bottomRightCorner<3, 3>() /= wr;
  out.topRightCorner<3, 3>() *= tie;
  out.bottomLeftCorner<3, 3>() *= tie;
  return out;
}

}  // namespace asperity::inertial_smoother
