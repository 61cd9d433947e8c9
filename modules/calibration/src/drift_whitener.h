#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

namespace asperity {

// What an integrated sensor drifts by: an angle as a random walk, a position as the integral of one.
enum class DriftKind { kRandomWalk, kIntegratedRandomWalk };

// Columns of samples made independent and of the white noise's variance, under y = drift + white noise, by the
// innovations of a Kalman filter that knows nothing at the start of each run. Being linear, it treats residuals and
// slopes alike.
struct Whitened {
  Eigen::MatrixXd rows;          // as many as samples; those that a run's start takes are zero
  double log_determinant = 0.0;  // of the innovations' variances over the white noise's
  int count = 0;                 // rows that are not taken
};

// `ratio`: variance rate of the drift (of the angle per s; of the velocity per s) over the white noise's variance.
Whitened whiten_series(DriftKind kind, const std::vector<double>& t_s, const std::vector<std::uint8_t>& starts,
                       double ratio, const Eigen::MatrixXd& columns);

// The ratio at which `residual` (one column) is most likely, its white variance being free.
double most_likely_ratio(DriftKind kind, const std::vector<double>& t_s, const std::vector<std::uint8_t>& starts,
                         const Eigen::MatrixXd& residual);

}  // namespace asperity
