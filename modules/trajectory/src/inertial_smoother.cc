#include "inertial_smoother.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>

#include "inertial_model.h"

namespace asperity::inertial_smoother {

namespace {

using Gain = Eigen::Matrix<double, Eigen::Dynamic, 6, 0, kMax, 6>;
using Matrix6d = Eigen::Matrix<double, 6, 6>;

// P ← Φ P Φᵀ with Φ = I + U.
void propagate(Square& P, const TopRows& U) {
  const TopRows UP = U * P;
  P.topRows(9) += UP;
  const Eigen::Matrix<double, Eigen::Dynamic, 9, 0, kMax, 9> PU = P * U.transpose();
  P.leftCols(9) += PU;
}

// Λ ← Φᵀ Λ Φ.
void propagate_back(Square& L, const TopRows& U) {
  const Square UL = U.transpose() * L.topRows(9);
  L += UL;
  const Square LU = L.leftCols(9) * U;
  L += LU;
}

struct Record {
  Nominal x;  // after the update
  Square P;   // after the update
  Gain K;
  Jacobian H;
  Matrix6d S_inverse;
  Vector6d y;
  bool updated = false;
  int refused_in_a_row = 0;
};

struct Forward {
  std::vector<Record> records;  // per epoch; empty if only the likelihood was wanted
  Checkpoint last;
  double log_likelihood = 0.0;
};

Forward run_forward(const Problem& problem, bool keep, const Observer& observer) {
  const Layout& layout = problem.layout;
  Forward out;
  if (keep) out.records.resize(problem.epochs.size());
  Nominal x = problem.start;
  Square P = problem.start_covariance;
  int refused_in_a_row = problem.refused_in_a_row;
  for (std::size_t e = 0; e < problem.epochs.size(); ++e) {
    if (e > 0) {
      const Mounting mounting = mounting_of(x, problem);
      Transition transition;
      for (std::size_t k = problem.epochs[e - 1].knot; k < problem.epochs[e].knot; ++k) {
        const Knot& k0 = problem.knots[k];
        const Knot& k1 = problem.knots[k + 1];
        const Step step = advance(x, k0, k1, mounting, problem.gravity, {});
        transition.extend(step, k0, k1, mounting, problem);
      }
      propagate(P, transition.rows(layout));
      transition.add_noise(problem, P);
      P = (0.5 * (P + P.transpose())).eval();
    }
    Record record;
    const std::int64_t pose = problem.epochs[e].pose;
    if (pose >= 0) {
      const auto i = static_cast<std::size_t>(pose);
      const Vector3d omega = mounting_of(x, problem).gyro * problem.knots[problem.epochs[e].knot].w - x.bg;
      const Predicted predicted = predict_pose(x, omega, problem.poses[i], layout);
      const Eigen::Matrix<double, 6, Eigen::Dynamic, 0, 6, kMax> HP = predicted.H * P;
      Matrix6d S = HP * predicted.H.transpose();
      const Vector3d timing = predicted.v_marker * problem.time_sigma;
      Matrix6d noise = Matrix6d::Zero();
      noise.diagonal().head<3>() = problem.sigma_position.cwiseAbs2();
      noise.diagonal().tail<3>() = problem.sigma_rotation.cwiseAbs2();
      noise.topLeftCorner<3, 3>() += timing * timing.transpose();
      double wp = problem.position_weight[i];
      double wr = problem.rotation_weight[i];
      if (problem.gate_innovations) {
        const Matrix6d trial = S + noise;
        const Vector3d yp = predicted.residual.head<3>();
        const Vector3d yr = predicted.residual.tail<3>();
        wp = redescending(yp.dot(trial.topLeftCorner<3, 3>().ldlt().solve(yp)), problem.gate_chi2);
        wr = redescending(yr.dot(trial.bottomRightCorner<3, 3>().ldlt().solve(yr)), problem.gate_chi2);
        // A filter that refuses everything is itself wrong: after a dozen poses it listens again.
        refused_in_a_row = wp < 0.05 || wr < 0.05 ? refused_in_a_row + 1 : 0;
        if (refused_in_a_row > 12) wp = wr = 1.0, refused_in_a_row = 0;
      }
      // A pose with a wrong orientation seldom has the right position.
      wp = std::min(wp, std::sqrt(wr));
      noise.topLeftCorner<3, 3>() /= std::max(wp, 1e-9);
      noise.bottomRightCorner<3, 3>() /= std::max(wr, 1e-9);
      S += noise;
      const Eigen::LLT<Matrix6d> factor(S);
      const Matrix6d S_inverse = factor.solve(Matrix6d::Identity());
      const Gain K = HP.transpose() * S_inverse;
      const Vector6d& y = predicted.residual;
      const double d2 = y.dot(S_inverse * y);
      const Vector6d diagonal = factor.matrixL().toDenseMatrix().diagonal();
      // Down-weighted poses are left out of the likelihood: their share would reward a bad model.
      if (wp > 0.5 && wr > 0.5) {
        out.log_likelihood -= 0.5 * std::min(d2, 2.0 * problem.gate_chi2) + diagonal.array().log().sum();
      } else if (problem.gate_innovations) {
        out.log_likelihood -= problem.gate_chi2 + diagonal.array().log().sum();
      }
      apply(K * y, layout, x);
      P -= K * HP;
      P = (0.5 * (P + P.transpose())).eval();
      if (keep) {
        record.K = K;
        record.H = predicted.H;
        record.S_inverse = S_inverse;
        record.y = y;
        record.updated = true;
      }
    }
    if (keep) {
      record.x = x;
      record.P = P;
      record.refused_in_a_row = refused_in_a_row;
      out.records[e] = std::move(record);
      if (e % 256 == 0) observer.update("filter", static_cast<double>(e) / static_cast<double>(problem.epochs.size()));
    }
  }
  out.last = {x, P, refused_in_a_row};
  return out;
}

// Shares the small second-order difference between the end of one interval and the start of the next
// over the interval, so that the path has no steps.
struct Seam {
  Vector3d p = Vector3d::Zero();
  Vector3d v = Vector3d::Zero();
  Vector3d phi = Vector3d::Zero();
};

}  // namespace

double log_likelihood(const Problem& problem) { return run_forward(problem, false, {}).log_likelihood; }

Filtered filter(const Problem& problem) {
  const Forward forward = run_forward(problem, false, {});
  return {forward.log_likelihood, forward.last};
}

Smoothed smooth(const Problem& problem, const Vector3d& tip_in_marker, const Observer& observer) {
  const Layout& layout = problem.layout;
  const int n = layout.size;
  const std::vector<Record> records = run_forward(problem, true, observer).records;
  const std::size_t epochs = records.size();
  std::size_t samples = 0;
  for (const Knot& knot : problem.knots) samples += knot.sample >= 0;

  Smoothed out;
  out.sample.resize(samples);
  out.p.resize(samples);
  out.v.resize(samples);
  out.a.resize(samples);
  out.omega_world.resize(samples);
  out.q.resize(samples);
  out.position_residual.assign(problem.poses.size(), Vector3d::Zero());
  out.rotation_residual.assign(problem.poses.size(), Vector3d::Zero());
  out.epoch_t.resize(epochs);
  out.tip_covariance.resize(epochs);
  const Record& checkpoint = records[std::min(problem.checkpoint_epoch, epochs - 1)];
  out.checkpoint = {checkpoint.x, checkpoint.P, checkpoint.refused_in_a_row};
  out.last_sigma = records.back().P.diagonal().cwiseMax(0.0).cwiseSqrt();

  State lambda = State::Zero(n);  // the adjoint after the epoch in hand
  Square Lambda = Square::Zero(n, n);
  std::vector<Step> steps;
  std::vector<Nominal> path;
  std::vector<Noise> noises;
  Nominal next;  // the smoothed state at the epoch after the one in hand
  std::size_t place = samples;

  for (std::size_t e = epochs; e-- > 0;) {
    const Record& record = records[e];
    const Nominal filtered = record.x;
    State lambda_end = lambda;  // at the end of the interval that begins here, before that epoch's update
    TopRows U;
    const std::size_t first = problem.epochs[e].knot;
    const std::size_t last = e + 1 < epochs ? problem.epochs[e + 1].knot : first;
    const Mounting mounting = mounting_of(filtered, problem);
    if (e + 1 < epochs) {
      Nominal x = filtered;
      Transition transition;
      steps.clear();
      for (std::size_t k = first; k < last; ++k) {
        const Knot& k0 = problem.knots[k];
        const Knot& k1 = problem.knots[k + 1];
        steps.push_back(advance(x, k0, k1, mounting, problem.gravity, {}));
        transition.extend(steps.back(), k0, k1, mounting, problem);
      }
      U = transition.rows(layout);
      lambda += (U.transpose() * lambda_end.head(9)).eval();
      propagate_back(Lambda, U);
    }

    Nominal smoothed = filtered;
    apply(-(record.P * lambda), layout, smoothed);
    const Matrix3d R = smoothed.q.toRotationMatrix();
    Eigen::Matrix<double, 3, Eigen::Dynamic, 0, 3, kMax> J =
        Eigen::Matrix<double, 3, Eigen::Dynamic, 0, 3, kMax>::Zero(3, n);
    J.block<3, 3>(0, kP).setIdentity();
    J.block<3, 3>(0, kPhi) = -skew(R * (tip_in_marker - smoothed.lever));
    if (layout.lever >= 0) J.block<3, 3>(0, layout.lever) = -R;
    const Eigen::Matrix<double, 3, Eigen::Dynamic, 0, 3, kMax> JP = J * record.P;
    out.tip_covariance[e] = JP * J.transpose() - JP * Lambda * JP.transpose();
    out.epoch_t[e] = problem.knots[first].t;

    const std::int64_t pose = problem.epochs[e].pose;
    if (pose >= 0) {
      const Vector3d omega = mounting.gyro * problem.knots[first].w - smoothed.bg;
      const Vector6d residual =
          predict_pose(smoothed, omega, problem.poses[static_cast<std::size_t>(pose)], layout).residual;
      out.position_residual[static_cast<std::size_t>(pose)] = residual.head<3>();
      out.rotation_residual[static_cast<std::size_t>(pose)] = residual.tail<3>();
    }

    if (e + 1 < epochs) {
      // Inside the interval the smoothed motion is the dead reckoning from its smoothed start with the
      // smoothed noise −Q Gᵀ λ(t) as a further input (Bryson and Frazier's form of the smoother).
      const Vector3d lp = lambda_end.segment<3>(kP);
      Vector3d lv = lambda_end.segment<3>(kV);
      Vector3d lphi = lambda_end.segment<3>(kPhi);
      Vector3d lbg = lambda_end.segment<3>(kBg);
      noises.resize(steps.size());
      for (std::size_t k = steps.size(); k-- > 0;) {
        const Knot& knot = problem.knots[first + k];
        const double dt = problem.knots[first + k + 1].t - knot.t;
        const Step& step = steps[k];
        noises[k].dv = -problem.process_scale * knot.accel_psd * dt * (lv + 0.5 * dt * lp);
        noises[k].dphi = -knot.gyro_psd * dt * lphi;
        noises[k].dbg =
            -problem.rate_scale * problem.gyro_bias_psd * dt * (lbg - 0.5 * dt * (step.R0.transpose() * lphi));
        lbg -= dt * (step.R0.transpose() * lphi);
        lphi += step.A.cross(dt * lv + 0.5 * dt * dt * lp);
        lv += dt * lp;
      }
      Nominal x = smoothed;
      path.resize(steps.size());
      const Mounting smoothed_mounting = mounting_of(smoothed, problem);
      for (std::size_t k = 0; k < steps.size(); ++k) {
        path[k] = x;
        steps[k] = advance(x, problem.knots[first + k], problem.knots[first + k + 1], smoothed_mounting,
                           problem.gravity, noises[k]);
      }
      Seam seam;
      seam.p = next.p - x.p;
      seam.v = next.v - x.v;
      seam.phi = log_rotation(next.q * x.q.conjugate());
      const double t0 = problem.knots[first].t;
      const double T = problem.knots[last].t - t0;
      for (std::size_t k = steps.size(); k-- > 0;) {
        const Knot& knot = problem.knots[first + k];
        if (knot.sample < 0) continue;
        const double share = (knot.t - t0) / T;
        --place;
        out.sample[place] = knot.sample;
        out.p[place] = path[k].p + share * seam.p;
        out.v[place] = path[k].v + share * seam.v;
        out.q[place] = (exp_rotation(share * seam.phi) * path[k].q).normalized();
        out.a[place] = steps[k].a0;
        out.omega_world[place] = steps[k].R0 * steps[k].omega0;
      }
    } else {
      out.last = smoothed;
      if (problem.knots[first].sample >= 0) {
        --place;
        out.sample[place] = problem.knots[first].sample;
        out.p[place] = smoothed.p;
        out.v[place] = smoothed.v;
        out.q[place] = smoothed.q;
        out.a[place] = smoothed.q * (mounting.accel * problem.knots[first].f - smoothed.ba) + problem.gravity;
        out.omega_world[place] = smoothed.q * (mounting.gyro * problem.knots[first].w - smoothed.bg);
      }
    }
    next = smoothed;
    if (e == 0) out.first = smoothed;

    if (record.updated) {
      // λ̃ = Cᵀ λ̂ − Hᵀ S⁻¹ y and Λ̃ = Cᵀ Λ̂ C + Hᵀ S⁻¹ H with C = I − K H.
      const Vector6d correction = record.S_inverse * record.y + record.K.transpose() * lambda;
      lambda -= record.H.transpose() * correction;
      const Eigen::Matrix<double, Eigen::Dynamic, 6, 0, kMax, 6> LK = Lambda * record.K;
      const Matrix6d middle = record.K.transpose() * LK + record.S_inverse;
      const Eigen::Matrix<double, Eigen::Dynamic, 6, 0, kMax, 6> Ht = record.H.transpose();
      const Square cross = LK * record.H;
      Lambda += Ht * middle * record.H - cross - cross.transpose();
      Lambda = (0.5 * (Lambda + Lambda.transpose())).eval();
    }
    if (e % 256 == 0) observer.update("smoother", 1.0 - static_cast<double>(e) / static_cast<double>(epochs));
  }
  return out;
}

}  // namespace asperity::inertial_smoother
