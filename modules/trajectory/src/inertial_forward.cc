#include "inertial_forward.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>

#include "symmetric_products.h"
#include "transition_sum.h"

namespace asperity::inertial_smoother {

Square Record::covariance(int n) const {
  Square out(n, n);
  std::size_t at = 0;
  for (int c = 0; c < n; ++c) {
    for (int r = 0; r <= c; ++r) out(r, c) = out(c, r) = P[at++];
  }
  return out;
}

void Record::keep(const Square& covariance) {
  const auto n = static_cast<int>(covariance.cols());
  P.resize(static_cast<std::size_t>(n * (n + 1) / 2));
  std::size_t at = 0;
  for (int c = 0; c < n; ++c) {
    for (int r = 0; r <= c; ++r) P[at++] = covariance(r, c);
  }
}

namespace {

// Beyond, some minutes, the smoother sums them up again: 3 kB each.
constexpr std::size_t kMostTransitions = 20'000;

}  // namespace

Forward run_forward(const Problem& problem, bool keep, const Observer& observer) {
  const Layout& layout = problem.layout;
  Forward out;
  if (keep) out.records.resize(problem.epochs.size());
  Nominal x = problem.start;
  Square P = start_covariance(problem);
  int refused_in_a_row = problem.refused_in_a_row;
  const bool keep_transitions = keep && problem.epochs.size() <= kMostTransitions;
  auto restart = problem.restarts.begin();
  for (std::size_t e = 0; e < problem.epochs.size(); ++e) {
    if (restart != problem.restarts.end() && restart->epoch == e) {
      restart_motion(problem, *restart++, x, P);
      refused_in_a_row = 0;
    } else if (e > 0) {
      const Mounting mounting = mounting_of(x, problem);
      TransitionSum sum(problem);
      for (std::size_t k = problem.epochs[e - 1].knot; k < problem.epochs[e].knot; ++k) {
        const Knot& k0 = problem.knots[k];
        const Knot& k1 = problem.knots[k + 1];
        const Step step = advance_state(x, k0, k1, mounting, nullptr);
        sum.extend(step, k0, k1, mounting, problem.gyro_turns_too);
      }
      const Transition transition = sum.transition();
      transition.propagate(problem, transition.rows(layout), x, P);
      if (keep_transitions) out.records[e - 1].transition.assign(1, transition);
    }
    const std::int64_t pose = problem.epochs[e].pose;
    if (pose >= 0) {
      const auto i = static_cast<std::size_t>(pose);
      const Vector3d omega = mounting_of(x, problem).gyro * problem.knots[problem.epochs[e].knot].w - x.bg;
      const Predicted predicted = predict_pose(x, omega, problem.poses[i]);
      const Jacobian HP = predicted.times(P, layout);
      Matrix6d S = predicted.times(HP.transpose(), layout);
      const MeasurementNoise noise = measurement_noise(problem, i, predicted.rate);
      double wp = problem.position_weight[i];
      double wr = problem.rotation_weight[i];
      const Vector6d& y = predicted.residual;
      const bool by_innovation = problem.gate_innovations || wp == 0.0;
      if (by_innovation) {
        const Matrix6d trial = S + noise.covariance(1.0, 1.0);
        const Vector3d yp = y.head<3>();
        const Vector3d yr = y.tail<3>();
        wp = redescending(yp.dot(trial.topLeftCorner<3, 3>().ldlt().solve(yp)), problem.gate_chi2);
        wr = redescending(yr.dot(trial.bottomRightCorner<3, 3>().ldlt().solve(yr)), problem.gate_chi2);
        // A filter that refuses everything is itself wrong: after a dozen poses it listens again.
        refused_in_a_row = wp < 0.05 || wr < 0.05 ? refused_in_a_row + 1 : 0;
        if (refused_in_a_row > 12) wp = wr = 1.0, refused_in_a_row = 0;
      }
      // A pose with a wrong orientation seldom has the right position.
      wp = std::min(wp, std::sqrt(wr));
      const Matrix6d N = noise.covariance(wp, wr);
      S += N;
      const Eigen::LLT<Matrix6d> factor(S);
      const Matrix6d S_inverse = factor.solve(Matrix6d::Identity());
      const double d2 = y.dot(S_inverse * y);
      const Vector6d diagonal = factor.matrixL().toDenseMatrix().diagonal();
      const bool believed = wp > 0.5 && wr > 0.5;
      // Down-weighted poses are left out of the likelihood: their share would reward a bad model.
      if (believed) {
        out.log_likelihood -= 0.5 * std::min(d2, 2.0 * problem.gate_chi2) + diagonal.array().log().sum();
      } else if (by_innovation) {
        out.log_likelihood -= problem.gate_chi2 + diagonal.array().log().sum();
      }
      apply_correction(HP.transpose().lazyProduct(Vector6d(S_inverse * y)), layout, x);
      const Matrix6d root = factor.matrixL().solve(Matrix6d::Identity());
      Jacobian half(6, HP.cols());
      for (Eigen::Index c = 0; c < HP.cols(); ++c) half.col(c) = root * HP.col(c);
      add_transposed_product<6>(-1.0, half, half, P);
      if (keep) {
        Record& record = out.records[e];
        record.predicted = predicted;
        record.S_inverse = S_inverse;
        record.N_inverse = N.llt().solve(Matrix6d::Identity());
        record.updated = true;
        record.believed = believed;
      }
    }
    if (keep) {
      Record& record = out.records[e];
      record.x = x;
      record.keep(P);
      record.refused_in_a_row = refused_in_a_row;
      if (e % 256 == 0) observer.update("filter", static_cast<double>(e) / static_cast<double>(problem.epochs.size()));
    }
  }
  out.last = {x, P, refused_in_a_row};
  return out;
}

double log_likelihood(const Problem& problem) { return run_forward(problem, false, {}).log_likelihood; }

Filtered filter_motion(const Problem& problem) {
  const Forward forward = run_forward(problem, false, {});
  return {forward.log_likelihood, forward.last};
}

}  // namespace asperity::inertial_smoother
