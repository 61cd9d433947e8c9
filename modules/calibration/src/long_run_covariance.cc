#include "long_run_covariance.h"

#include <algorithm>
#include <cmath>

#include "asperity/algebra/solve.h"

namespace asperity {

namespace {

std::size_t longest_of(const std::vector<RowRun>& runs) {
  std::size_t out = 0;
  for (const RowRun& run : runs) out = std::max(out, run.last - run.first);
  return out;
}

// Sum over the runs of products of rows `lag` apart, over the number of all rows.
Eigen::MatrixXd moment(const Eigen::MatrixXd& scores, const std::vector<RowRun>& runs, std::size_t lag) {
  Eigen::MatrixXd out = Eigen::MatrixXd::Zero(scores.cols(), scores.cols());
  double rows = 0.0;
  for (const RowRun& run : runs) {
    rows += static_cast<double>(run.last - run.first);
    if (run.last <= run.first + lag) continue;
    const auto count = static_cast<Eigen::Index>(run.last - run.first - lag);
    const auto first = static_cast<Eigen::Index>(run.first);
    out.noalias() +=
        scores.middleRows(first, count).transpose() * scores.middleRows(first + static_cast<Eigen::Index>(lag), count);
  }
  return out / rows;
}

}  // namespace

Eigen::MatrixXd long_run_covariance(const Eigen::MatrixXd& scores, const std::vector<RowRun>& runs, double leverage) {
  // Beyond a tenth of the longest run there are too few products to learn a correlation from.
  const std::size_t most = std::max<std::size_t>(longest_of(runs) / 10, 1);
  std::vector<Eigen::MatrixXd> gamma{moment(scores, runs, 0)};
  const Eigen::VectorXd variance = gamma[0].diagonal();
  // Sokal's window, a column: the first lag beyond five times the correlation time summed up to it.
  constexpr double kTimes = 5.0;
  Eigen::VectorXd time = Eigen::VectorXd::Constant(scores.cols(), 0.5);
  std::vector<bool> settled(static_cast<std::size_t>(scores.cols()), false);
  std::size_t window = 1;
  for (std::size_t lag = 1; lag <= most; ++lag) {
    gamma.push_back(moment(scores, runs, lag));
    bool all = true;
    for (Eigen::Index k = 0; k < scores.cols(); ++k) {
      if (settled[static_cast<std::size_t>(k)] || !(variance[k] > 0.0)) continue;
      time[k] += gamma[lag](k, k) / variance[k];
      settled[static_cast<std::size_t>(k)] = static_cast<double>(lag) >= kTimes * time[k];
      all = all && settled[static_cast<std::size_t>(k)];
    }
    window = lag;
    if (all) break;
  }
  Eigen::MatrixXd S = gamma[0];
  for (std::size_t lag = 1; lag <= 2 * window; ++lag) {
    const Eigen::MatrixXd once = lag < gamma.size() ? gamma[lag] : moment(scores, runs, lag);
    const double weight = std::min(1.0, 2.0 - static_cast<double>(lag) / static_cast<double>(window));
    S += weight * (once + once.transpose());
  }
  // The window's weights sum to 1 + 3·window: both sides, flat and sloping.
  S /= 1.0 - std::min(leverage * (1.0 + 3.0 * static_cast<double>(window)), 0.5);
  // The flat window may come out negative in a direction that hardly varies; independent rows are its floor then.
  const SymmetricEigen eigen = symmetric_eigen(S);
  if (eigen.values[0] > 0.0) return S;
  const Eigen::MatrixXd& V = eigen.vectors;
  const Eigen::VectorXd floor = (V.transpose() * gamma[0] * V).diagonal();
  return V * eigen.values.cwiseMax(floor).asDiagonal() * V.transpose();
}

}  // namespace asperity
