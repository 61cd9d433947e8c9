#include "fit_noise_law.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "asperity/algebra/solve.h"
#include "asperity/base/error.h"

namespace asperity {

namespace {

struct LinearLogs {
  Eigen::VectorXd values, errors;
  double chi_square = 0.0;
};

// Least squares with rows already divided by their errors.
LinearLogs solve_noise_law(const Eigen::MatrixXd& rows, const Eigen::VectorXd& right) {
  LinearLogs out;
  out.values = least_squares(rows, right).x;
  out.chi_square = (rows * out.values - right).squaredNorm();
  const Eigen::MatrixXd inverse = inverse_of(rows.transpose() * rows);
  out.errors = inverse.diagonal().cwiseSqrt();
  return out;
}

}  // namespace

NoiseLaw fit_noise_law(std::span<const NoiseAtPose> poses, double power, double least_tilt_ratio) {
  constexpr std::size_t kFewest = 3;
  if (poses.size() < kFewest)
    throw Error(fmt::format("noise law: {} poses, at least {} are needed", poses.size(), kFewest));
  const auto n = static_cast<Eigen::Index>(poses.size());
  Eigen::VectorXd distance(n), tilt(n), sigma(n), weight(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const NoiseAtPose& pose = poses[static_cast<std::size_t>(i)];
    distance[i] = std::log(pose.distance_m);
    tilt[i] = -std::log(std::cos(pose.tilt_rad));
    sigma[i] = std::log(pose.sigma);
    weight[i] = pose.sigma / pose.sigma_error;
    if (!std::isfinite(distance[i]) || !std::isfinite(tilt[i]) || !std::isfinite(sigma[i]) ||
        !std::isfinite(weight[i]) || !(weight[i] > 0.0)) {
      throw Error(fmt::format("noise law: pose {}: σ {} ± {} at {} m, {} rad", i, pose.sigma, pose.sigma_error,
                              pose.distance_m, pose.tilt_rad));
    }
  }
  NoiseLaw law;
  law.power = power;
  const bool tilt_fitted = n > 2 && tilt.maxCoeff() - tilt.minCoeff() >= std::log(least_tilt_ratio);
  const auto columns = tilt_fitted ? 2 : 1;
  Eigen::MatrixXd rows(n, columns);
  rows.col(0) = weight;
  if (tilt_fitted) rows.col(1) = weight.cwiseProduct(tilt);
  const LinearLogs held = solve_noise_law(rows, weight.cwiseProduct(sigma - power * distance));
  law.scale = std::exp(held.values[0]);
  law.scale_error = law.scale * held.errors[0];
  if (tilt_fitted) {
    law.tilt_power = held.values[1];
    law.tilt_power_error = held.errors[1];
  }
  law.chi_square = held.chi_square;
  law.degrees_of_freedom = static_cast<int>(n - columns);

  Eigen::MatrixXd free(n, columns + 1);
  free.leftCols(columns) = rows;
  // About the mean, so that the column of ones is not nearly this one.
  free.col(columns) = weight.cwiseProduct(Eigen::VectorXd(distance.array() - distance.mean()));
  const LinearLogs measured = solve_noise_law(free, weight.cwiseProduct(sigma));
  law.measured_power = measured.values[columns];
  law.measured_power_error = measured.errors[columns];
  return law;
}

}  // namespace asperity
