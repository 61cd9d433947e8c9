#include "asperity/calibration/fit_noise_law.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include <Eigen/QR>

#include "asperity/base/error.h"

namespace asperity {

namespace {

struct LinearLogs {
  Eigen::VectorXd values, errors;
  double chi_square = 0.0;
};

// Least squares with rows already divided by their errors.
LinearLogs solve_noise_law(const Eigen::MatrixXd& rows, const Eigen::VectorXd& right) {
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(rows);
  LinearLogs out;
  out.values = qr.solve(right);
  out.chi_square = (rows * out.values - right).squaredNorm();
  const Eigen::MatrixXd inverse = (rows.transpose() * rows).inverse();
  out.errors = inverse.diagonal().cwiseSqrt();
  return out;
}

}  // namespace

NoiseLaw fit_noise_law(std::span<const NoiseAtPlace> places, double power, double least_tilt_ratio) {
  constexpr std::size_t kFewest = 3;
  if (places.size() < kFewest)
    throw Error(fmt::format("noise law: {} places, at least {} are needed", places.size(), kFewest));
  const auto n = static_cast<Eigen::Index>(places.size());
  Eigen::VectorXd distance(n), tilt(n), sigma(n), weight(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const NoiseAtPlace& place = places[static_cast<std::size_t>(i)];
    distance[i] = std::log(place.distance_m);
    tilt[i] = -std::log(std::cos(place.tilt_rad));
    sigma[i] = std::log(place.sigma);
    weight[i] = place.sigma / place.sigma_error;
    if (!std::isfinite(distance[i]) || !std::isfinite(tilt[i]) || !std::isfinite(sigma[i]) ||
        !std::isfinite(weight[i]) || !(weight[i] > 0.0)) {
      throw Error(fmt::format("noise law: place {}: σ {} ± {} at {} m, {} rad", i, place.sigma, place.sigma_error,
                              place.distance_m, place.tilt_rad));
    }
  }
  NoiseLaw law;
  law.power = power;
  law.tilt_fitted = n > 2 && tilt.maxCoeff() - tilt.minCoeff() >= std::log(least_tilt_ratio);
  const auto columns = law.tilt_fitted ? 2 : 1;
  Eigen::MatrixXd rows(n, columns);
  rows.col(0) = weight;
  if (law.tilt_fitted) rows.col(1) = weight.cwiseProduct(tilt);
  const LinearLogs held = solve_noise_law(rows, weight.cwiseProduct(sigma - power * distance));
  law.scale = std::exp(held.values[0]);
  law.scale_error = law.scale * held.errors[0];
  if (law.tilt_fitted) {
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
