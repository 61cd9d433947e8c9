#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

namespace asperity {

// Rows first to last (exclusive).
struct RowRun {
  std::size_t first = 0;
  std::size_t last = 0;
};

// The covariance of the sum of the rows of `scores` (of mean zero) over their number, for rows that are correlated with
// those after them in the same run. The sums over lags end where Sokal's rule (1997) says that the slowest column's
// correlation is over, with a flat-top window (Politis and Romano, 1995): one to there, then falling to zero over as
// much again, so that correlation of any shape within it is taken whole. A fit has taken from each residual its share
// `leverage` (parameters over values) of what it shares with every residual in the window; that is given back, as
// N/(N − k) gives it back to a variance. Rows outside the runs do not count.
Eigen::MatrixXd long_run_covariance(const Eigen::MatrixXd& scores, const std::vector<RowRun>& runs, double leverage);

}  // namespace asperity
