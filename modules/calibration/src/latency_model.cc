#include "latency_model.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "asperity/algebra/solve.h"

namespace asperity {

namespace {

// Rows of one axis with the residual in column 0.
Eigen::MatrixXd axis_columns(const LatencyRows& rows, int axis) {
  const Eigen::Index poses = rows.residual.size() / 3;
  Eigen::MatrixXd out(poses, rows.slopes.cols() + 1);
  for (Eigen::Index i = 0; i < poses; ++i) {
    out(i, 0) = rows.residual[3 * i + axis];
    out.row(i).tail(rows.slopes.cols()) = rows.slopes.row(3 * i + axis);
  }
  return out;
}

struct Solution {
  Eigen::VectorXd step;
  Eigen::MatrixXd covariance;
  Eigen::Vector3d white;
  double cost = 0.0;
};

Solution solve_latency(const LatencyModel& model, const std::array<Eigen::MatrixXd, 3>& columns,
                       const Eigen::Vector3d& ratio, const Eigen::VectorXd& prior_sigma,
                       const Eigen::VectorXd& from_prior) {
  const Eigen::Index parameters = columns[0].cols() - 1;
  Eigen::MatrixXd information = Eigen::MatrixXd::Zero(parameters, parameters);
  Eigen::VectorXd gradient = Eigen::VectorXd::Zero(parameters);
  Solution out;
  // Each axis has its own white noise, from its own residual after the step: twice round.
  std::array<Eigen::MatrixXd, 3> rows;
  std::array<double, 3> freedom{};
  for (int axis = 0; axis < 3; ++axis) {
    const auto k = static_cast<std::size_t>(axis);
    Whitened w = whiten_series(model.drift(), model.pose_t_s(), model.starts(), ratio[axis], columns[k]);
    rows[k] = std::move(w.rows);
    freedom[k] = std::max(1.0, w.count - static_cast<double>(parameters) / 3.0);
    out.white[axis] = std::sqrt(rows[k].col(0).squaredNorm() / freedom[k]);
  }
  for (int round = 0; round < 3; ++round) {
    information.setZero();
    gradient.setZero();
    for (Eigen::Index p = 0; p < parameters; ++p) {
      if (!std::isfinite(prior_sigma[p])) continue;
      information(p, p) = 1.0 / (prior_sigma[p] * prior_sigma[p]);
      gradient[p] = -from_prior[p] / (prior_sigma[p] * prior_sigma[p]);
    }
    for (int axis = 0; axis < 3; ++axis) {
      const auto& r = rows[static_cast<std::size_t>(axis)];
      const double weight = 1.0 / (out.white[axis] * out.white[axis]);
      if (!std::isfinite(weight)) continue;
      information.noalias() += weight * r.rightCols(parameters).transpose() * r.rightCols(parameters);
      gradient.noalias() -= weight * r.rightCols(parameters).transpose() * r.col(0);
    }
    const Eigen::VectorXd scale = information.diagonal().cwiseSqrt().cwiseInverse();
    const Eigen::MatrixXd scaled = scale.asDiagonal() * information * scale.asDiagonal();
    Eigen::MatrixXd right(parameters, parameters + 1);
    right << scale.asDiagonal() * gradient, Eigen::MatrixXd(scale.asDiagonal());
    const Eigen::MatrixXd solved = scale.asDiagonal() * solve_symmetric(scaled, right);
    out.step = solved.col(0);
    out.covariance = solved.rightCols(parameters);
    for (int axis = 0; axis < 3; ++axis) {
      const auto k = static_cast<std::size_t>(axis);
      const Eigen::VectorXd left = rows[k].col(0) + rows[k].rightCols(parameters) * out.step;
      out.white[axis] = std::sqrt(left.squaredNorm() / freedom[k]);
    }
  }
  return out;
}

// The latency's growth as one more column, that of the latency times the time from the middle.
void fit_clock_rate(const LatencyModel& model, const std::array<Eigen::MatrixXd, 3>& columns,
                    const Eigen::VectorXd& prior, LatencyEstimate& out) {
  const std::vector<double>& t_s = model.pose_t_s();
  const double middle_s = 0.5 * (t_s.front() + t_s.back());
  std::array<Eigen::MatrixXd, 3> wider;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const Eigen::MatrixXd& from = columns[axis];
    wider[axis].resize(from.rows(), from.cols() + 1);
    wider[axis].leftCols(from.cols()) = from;
    for (Eigen::Index i = 0; i < from.rows(); ++i) {
      wider[axis](i, from.cols()) = from(i, 1) * (t_s[static_cast<std::size_t>(i)] - middle_s);
    }
  }
  Eigen::VectorXd sigma(prior.size() + 1);
  sigma << prior, std::numeric_limits<double>::infinity();
  Eigen::VectorXd from_prior(prior.size() + 1);
  from_prior << model.from_prior(), 0.0;
  const Solution solution = solve_latency(model, wider, out.ratio, sigma, from_prior);
  out.clock_rate = solution.step[prior.size()];
  out.clock_rate_error = std::sqrt(solution.covariance(prior.size(), prior.size()));
}

std::array<Eigen::MatrixXd, 3> columns_of(const LatencyModel& model) {
  const LatencyRows rows = model.rows();
  return {axis_columns(rows, 0), axis_columns(rows, 1), axis_columns(rows, 2)};
}

}  // namespace

LatencyEstimate estimate_latency(LatencyModel& model) {
  constexpr int kMostSteps = 15, kRounds = 3;
  constexpr double kSmallStep = 0.01;  // of a standard error
  LatencyEstimate out;
  const Eigen::VectorXd prior = model.prior_sigma();
  std::array<Eigen::MatrixXd, 3> columns = columns_of(model);
  // The drift is not known yet: one as large as the noise over a tenth of a second serves to begin.
  out.ratio.setConstant(model.drift() == DriftKind::kRandomWalk ? 10.0 : 1e3);
  for (int round = 0; round < kRounds; ++round) {
    out.converged = false;
    for (int i = 0; i < kMostSteps && !out.converged; ++i) {
      const Solution solution = solve_latency(model, columns, out.ratio, prior, model.from_prior());
      if (!solution.step.allFinite()) return out;
      out.covariance = solution.covariance;
      out.white = solution.white;
      out.converged = (solution.step.array().abs() < kSmallStep * out.covariance.diagonal().array().sqrt()).all();
      model.step(solution.step);
      columns = columns_of(model);
    }
    for (int axis = 0; axis < 3; ++axis) {
      // The poses show a drift below their own noise badly; the sensor's samples show its noise well.
      const double least = model.least_drift_rate() / (out.white[axis] * out.white[axis]);
      const double likely = most_likely_ratio(model.drift(), model.pose_t_s(), model.starts(),
                                              columns[static_cast<std::size_t>(axis)].leftCols<1>());
      out.ratio[axis] = std::isfinite(least) ? std::max(likely, least) : likely;
    }
  }
  const Solution last = solve_latency(model, columns, out.ratio, prior, model.from_prior());
  out.covariance = last.covariance;
  out.white = last.white;
  fit_clock_rate(model, columns, prior, out);
  out.worst_innovation = Eigen::VectorXd::Zero(columns[0].rows());
  for (int axis = 0; axis < 3; ++axis) {
    const Whitened w = whiten_series(model.drift(), model.pose_t_s(), model.starts(), out.ratio[axis],
                                     columns[static_cast<std::size_t>(axis)].leftCols<1>());
    out.worst_innovation = out.worst_innovation.cwiseMax(w.rows.col(0).cwiseAbs() / out.white[axis]);
  }
  return out;
}

}  // namespace asperity
