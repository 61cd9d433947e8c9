#include "asperity/study/bradley_terry.h"

#include <cmath>
#include <vector>

#include <Eigen/LU>

#include "asperity/base/error.h"

namespace asperity {

namespace {

constexpr int kMostSteps = 100'000;
constexpr double kStill = 1e-12;  // change of a worth, of itself

// How many things can be reached from the first along wins (or along losses).
Eigen::Index reached(const Eigen::MatrixXd& wins, bool along_wins) {
  const Eigen::Index n = wins.rows();
  std::vector<bool> seen(static_cast<std::size_t>(n), false);
  std::vector<Eigen::Index> open{0};
  seen[0] = true;
  Eigen::Index count = 1;
  while (!open.empty()) {
    const Eigen::Index i = open.back();
    open.pop_back();
    for (Eigen::Index j = 0; j < n; ++j) {
      if (i == j || seen[static_cast<std::size_t>(j)] || !((along_wins ? wins(i, j) : wins(j, i)) > 0.0)) continue;
      seen[static_cast<std::size_t>(j)] = true;
      open.push_back(j);
      ++count;
    }
  }
  return count;
}

Eigen::MatrixXd covariance_of(const Eigen::MatrixXd& count, const Eigen::VectorXd& worth) {
  const Eigen::Index n = worth.size();
  Eigen::MatrixXd information = Eigen::MatrixXd::Zero(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index j = 0; j < n; ++j) {
      if (i == j) continue;
      const double p = worth(i) / (worth(i) + worth(j));
      information(i, j) = -count(i, j) * p * (1.0 - p);
      information(i, i) -= information(i, j);
    }
  }
  // The information does not know the sum of all ln π: with that direction added it can be inverted.
  const Eigen::MatrixXd mean = Eigen::MatrixXd::Constant(n, n, 1.0 / static_cast<double>(n));
  return (information + mean).inverse() - mean;
}

}  // namespace

BradleyTerry fit_bradley_terry(const Eigen::MatrixXd& wins) {
  const Eigen::Index n = wins.rows();
  if (n != wins.cols()) throw Error("worths: the table of wins is not square");
  if (!wins.allFinite() || (wins.array() < 0.0).any())
    throw Error("worths: a count of wins is negative or not a number");
  BradleyTerry out;
  if (n < 2 || reached(wins, true) < n || reached(wins, false) < n) return out;
  out.exists = true;
  Eigen::MatrixXd count = wins + wins.transpose();
  count.diagonal().setZero();
  const Eigen::VectorXd won = wins.rowwise().sum() - wins.diagonal();
  Eigen::VectorXd worth = Eigen::VectorXd::Ones(n);
  for (int step = 0; step < kMostSteps && !out.converged; ++step) {
    Eigen::VectorXd next(n);
    for (Eigen::Index i = 0; i < n; ++i) {
      next(i) = won(i) / (count.row(i).transpose().array() / (worth.array() + worth(i))).sum();
    }
    next /= std::exp(next.array().log().mean());
    out.converged = ((next - worth).array().abs() <= kStill * worth.array()).all();
    worth = next;
  }
  out.worth_ln = worth.array().log();
  out.covariance = covariance_of(count, worth);
  return out;
}

}  // namespace asperity
