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

ForwardPass::ForwardPass(const Problem& problem)
    : problem_(&problem),
      x_(problem.start),
      P_(start_covariance(problem)),
      refused_in_a_row_(problem.refused_in_a_row) {}

void ForwardPass::step(Transition* before, Record* here) {
  const Problem& problem = *problem_;
  if (restart_ < problem.restarts.size() && problem.restarts[restart_].epoch == epoch_) {
    restart_motion(problem, problem.restarts[restart_++], x_, P_);
    refused_in_a_row_ = 0;
  } else if (epoch_ > 0) {
    carry(before);
  }
  if (here != nullptr) here->updated = here->believed = false;
  const std::int64_t pose = problem.epochs[epoch_].pose;
  if (pose >= 0) correct(static_cast<std::size_t>(pose), here);
  if (here != nullptr) {
    here->x = x_;
    here->keep(P_);
    here->refused_in_a_row = refused_in_a_row_;
  }
  ++epoch_;
}

void ForwardPass::carry(Transition* before) {
  const Problem& problem = *problem_;
  const Mounting mounting = mounting_of(x_, problem);
  TransitionSum sum(problem);
  const std::size_t first = problem.epochs[epoch_ - 1].knot, last = problem.epochs[epoch_].knot;
  Knot k0 = problem.knots[first];
  for (std::size_t k = first; k < last; ++k) {
    const Knot k1 = problem.knots[k + 1];
    const Step step = advance_state(x_, k0, k1, mounting, nullptr);
    sum.extend(step, k0, k1, mounting, problem.gyro_turns_too);
    k0 = k1;
  }
  const Transition transition = sum.transition();
  transition.propagate(problem, transition.rows(problem.layout), x_, P_);
  if (before != nullptr) *before = transition;
}

void ForwardPass::correct(std::size_t i, Record* here) {
  const Problem& problem = *problem_;
  const Layout& layout = problem.layout;
  const Vector3d omega = mounting_of(x_, problem).gyro * problem.knots[problem.epochs[epoch_].knot].w - x_.bg;
  const Predicted predicted = predict_pose(x_, omega, problem.poses[i]);
  const Jacobian HP = predicted.times(P_, layout);
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
    refused_in_a_row_ = wp < 0.05 || wr < 0.05 ? refused_in_a_row_ + 1 : 0;
    if (refused_in_a_row_ > 12) wp = wr = 1.0, refused_in_a_row_ = 0;
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
    log_likelihood_ -= 0.5 * std::min(d2, 2.0 * problem.gate_chi2) + diagonal.array().log().sum();
  } else if (by_innovation) {
    log_likelihood_ -= problem.gate_chi2 + diagonal.array().log().sum();
  }
  apply_correction(HP.transpose().lazyProduct(Vector6d(S_inverse * y)), layout, x_);
  const Matrix6d root = factor.matrixL().solve(Matrix6d::Identity());
  Jacobian half(6, HP.cols());
  for (Eigen::Index c = 0; c < HP.cols(); ++c) half.col(c) = root * HP.col(c);
  add_transposed_product<6>(-1.0, half, half, P_);
  if (here == nullptr) return;
  here->predicted = predicted;
  here->S_inverse = S_inverse;
  here->N_inverse = N.llt().solve(Matrix6d::Identity());
  here->updated = true;
  here->believed = believed;
}

ForwardRecords::ForwardRecords(const Problem& problem, const Observer& observer, std::size_t block_epochs)
    : observer_(observer.without_progress()), epochs_(problem.epochs.size()), block_epochs_(block_epochs) {
  records_.resize(std::min(block_epochs_, epochs_));
  ForwardPass pass(problem);
  for (std::size_t block = 0; block * block_epochs_ < epochs_; ++block) {
    begins_.push_back(pass);
    fill(pass, block, observer);
  }
}

void ForwardRecords::fill(ForwardPass& pass, std::size_t block, const Observer& observer) {
  const std::size_t first = block * block_epochs_, last = std::min(first + block_epochs_, epochs_);
  block_ = begins_.size();  // none, should this be cancelled
  for (std::size_t e = first; e < last; ++e) {
    Record& record = records_[e - first];
    pass.step(e > first ? &records_[e - first - 1].transition : nullptr, &record);
    if (e % 256 == 0) observer.update("filter", static_cast<double>(e) / static_cast<double>(epochs_));
  }
  // The transition out of the block, by a step into the next one.
  if (last < epochs_) ForwardPass(pass).step(&records_[last - first - 1].transition, nullptr);
  block_ = block;
}

const Record& ForwardRecords::at(std::size_t epoch) {
  const std::size_t block = epoch / block_epochs_;
  if (block != block_) {
    ForwardPass pass = begins_[block];
    fill(pass, block, observer_);
  }
  return records_[epoch - block * block_epochs_];
}

double log_likelihood(const Problem& problem) { return filter_motion(problem).log_likelihood; }

Filtered filter_motion(const Problem& problem) {
  ForwardPass pass(problem);
  for (std::size_t e = 0; e < problem.epochs.size(); ++e) pass.step(nullptr, nullptr);
  return {pass.log_likelihood(), pass.state()};
}

}  // namespace asperity::inertial_smoother
