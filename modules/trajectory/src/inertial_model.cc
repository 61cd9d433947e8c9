#include "inertial_model.h"

namespace asperity::inertial_smoother {

Mounting mounting_of(const Nominal& x, const Problem& problem) {
  const Matrix3d M = x.misalignment.toRotationMatrix();
  return {M, problem.gyro_turns_too ? M : Matrix3d(Matrix3d::Identity())};
}

Step advance(Nominal& x, const Knot& k0, const Knot& k1, const Mounting& mounting, const Vector3d& gravity,
             const Noise& noise) {
  const double dt = k1.t - k0.t;
  Step step;
  step.R0 = x.q.toRotationMatrix();
  step.omega0 = mounting.gyro * k0.w - x.bg;
  step.w = mounting.gyro * (0.5 * (k0.w + k1.w));
  const Vector3d A0 = step.R0 * (mounting.accel * k0.f - x.ba);
  x.q = (x.q * exp_rotation((step.w - x.bg) * dt)).normalized();
  const Vector3d A1 = x.q * (mounting.accel * k1.f - x.ba);
  step.A = 0.5 * (A0 + A1);
  step.a0 = A0 + gravity;
  x.p += dt * x.v + dt * dt * ((2.0 * A0 + A1) / 6.0 + 0.5 * gravity) + 0.5 * dt * noise.dv;
  x.v += dt * (step.A + gravity) + noise.dv;
  x.q = exp_rotation(noise.dphi) * x.q;
  x.bg += noise.dbg;
  return step;
}

void Transition::extend(const Step& s, const Knot& k0, const Knot& k1, const Mounting& mounting,
                        const Problem& problem) {
  const double dt = k1.t - k0.t;
  const double half = 0.5 * dt * dt;
  if (problem.layout.misalignment >= 0) {
    const Vector3d f_marker = mounting.accel * (0.5 * (k0.f + k1.f));
    const Matrix3d force = -(s.R0 * skew(f_marker)) - skew(s.A) * phimu;
    pmu += dt * vmu + half * force;
    vmu += dt * force;
    if (problem.gyro_turns_too) phimu -= dt * s.R0 * skew(s.w);
  }
  const Matrix3d leak = skew(s.A) * (g1 + 0.5 * dt * s.R0);
  pbg += dt * vbg + half * leak;
  vbg += dt * leak;
  g2 += dt * g1 + half * s.R0;
  g1 += dt * s.R0;
  sp += dt * sv + half * s.A;
  sv += dt * s.A;
  const double white = problem.process_scale * k0.accel_psd * dt;
  qpp += dt * (2.0 * qpv + dt * qvv) + 0.25 * dt * dt * white;
  qpv += dt * qvv + 0.5 * dt * white;
  qvv += white;
  qphi += k0.gyro_psd * dt;
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
  return U;
}

void Transition::add_noise(const Problem& problem, Square& P) const {
  const double rate = problem.rate_scale * problem.gyro_bias_psd;
  const Matrix3d mean_R = T > 0.0 ? Matrix3d(g1 / T) : Matrix3d::Identity();
  P.block<3, 3>(kP, kP).diagonal().array() += qpp;
  P.block<3, 3>(kP, kV).diagonal().array() += qpv;
  P.block<3, 3>(kV, kP).diagonal().array() += qpv;
  P.block<3, 3>(kV, kV).diagonal().array() += qvv;
  P.block<3, 3>(kPhi, kPhi).diagonal().array() += qphi + rate * T * T * T / 3.0;
  P.block<3, 3>(kPhi, kBg) -= 0.5 * rate * T * T * mean_R;
  P.block<3, 3>(kBg, kPhi) -= 0.5 * rate * T * T * mean_R.transpose();
  P.block<3, 3>(kBg, kBg).diagonal().array() += rate * T;
  P.block<3, 3>(kBa, kBa).diagonal().array() += problem.accel_bias_psd * T;
}

void apply(const State& d, const Layout& layout, Nominal& x) {
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
}

Predicted predict_pose(const Nominal& x, const Vector3d& omega, const Pose& pose, const Layout& layout) {
  Predicted out;
  const Matrix3d R = x.q.toRotationMatrix();
  const Vector3d arm = R * x.lever;
  const Vector3d omega_world = R * omega;
  out.v_marker = x.v - omega_world.cross(arm);
  out.residual.head<3>() = pose.translation_m - (x.p - arm - out.v_marker * x.latency);
  out.residual.tail<3>() = log_rotation(pose.rotation * x.q.conjugate()) + omega_world * x.latency;
  out.H = Jacobian::Zero(6, layout.size);
  out.H.block<3, 3>(0, kP).setIdentity();
  out.H.block<3, 3>(0, kPhi) = skew(arm);
  out.H.block<3, 3>(3, kPhi).setIdentity();
  if (layout.latency >= 0) {
    out.H.block<3, 1>(0, layout.latency) = -out.v_marker;
    out.H.block<3, 1>(3, layout.latency) = -omega_world;
  }
  if (layout.lever >= 0) out.H.block<3, 3>(0, layout.lever) = -R;
  return out;
}

}  // namespace asperity::inertial_smoother
