#include "friction_laws.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Core>

#include "asperity/algebra/solve.h"

namespace asperity {

namespace {

struct LinearLaw {
  Eigen::VectorXd value, standard_error;
  double residual_power = 0.0;
};

LinearLaw fit_law(const Eigen::MatrixXd& columns, const Eigen::VectorXd& y) {
  LinearLaw out;
  const Eigen::MatrixXd information = columns.transpose() * columns;
  const Eigen::MatrixXd inverse = inverse_of(information);
  out.value = inverse * columns.transpose() * y;
  const Eigen::VectorXd residual = y - columns * out.value;
  out.residual_power = residual.squaredNorm();
  const double n = independent_count({residual.begin(), residual.end()});
  const double freedom = std::max(1.0, n - static_cast<double>(columns.cols()));
  const double variance = out.residual_power / static_cast<double>(y.size()) * n / freedom;
  out.standard_error = (inverse.diagonal() * variance * static_cast<double>(y.size()) / n).cwiseMax(0.0).cwiseSqrt();
  return out;
}

}  // namespace

double independent_count(const std::vector<double>& residual) {
  double power = 0.0, lagged = 0.0;
  for (std::size_t i = 0; i < residual.size(); ++i) {
    power += residual[i] * residual[i];
    if (i > 0) lagged += residual[i] * residual[i - 1];
  }
  const double rho = power > 0.0 ? std::clamp(lagged / power, 0.0, 0.95) : 0.0;
  return static_cast<double>(residual.size()) * (1.0 - rho) / (1.0 + rho);
}

void fit_slopes(FrictionEstimate& out) {
  const auto n = static_cast<Eigen::Index>(out.windows.size());
  if (n <= 3) return;
  Eigen::MatrixXd columns(n, 3);
  Eigen::VectorXd y(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const FrictionWindow& window = out.windows[static_cast<std::size_t>(i)];
    columns.row(i) << 1.0, window.speed_mps - out.speed_mps, std::log(window.force_N / out.force_N);
    y[i] = window.coefficient;
  }
  const Eigen::MatrixXd about_mean = columns.rightCols(2).rowwise() - columns.rightCols(2).colwise().mean();
  const Eigen::Vector2d spread = about_mean.colwise().norm();
  const double cosine = about_mean.col(0).dot(about_mean.col(1)) / (spread[0] * spread[1]);
  if (!(spread[0] > 0.0) || !(spread[1] > 0.0) || !(std::abs(cosine) < 0.99)) return;
  const LinearLaw law = fit_law(columns, y);
  out.per_mps = law.value[1];
  out.per_mps_stderr = law.standard_error[1];
  out.per_log_force = law.value[2];
  out.per_log_force_stderr = law.standard_error[2];
}

void fit_stribeck(FrictionEstimate& out) {
  constexpr double kSpan = 3.0, kEvidence = 10.0;  // "very strong" (Kass and Raftery 1995)
  const auto [slowest, fastest] =
      std::minmax_element(out.windows.begin(), out.windows.end(),
                          [](const FrictionWindow& a, const FrictionWindow& b) { return a.speed_mps < b.speed_mps; });
  if (!(fastest->speed_mps > kSpan * slowest->speed_mps)) return;
  const auto n = static_cast<Eigen::Index>(out.windows.size());
  Eigen::VectorXd y(n);
  for (Eigen::Index i = 0; i < n; ++i) y[i] = out.windows[static_cast<std::size_t>(i)].coefficient;
  const Eigen::VectorXd about_mean = y.array() - y.mean();
  double best_power = about_mean.squaredNorm();
  StribeckLaw best;
  Eigen::VectorXd residual = about_mean;
  for (double speed_mps = 0.5 * slowest->speed_mps; speed_mps < fastest->speed_mps; speed_mps *= 1.2) {
    Eigen::MatrixXd columns(n, 2);
    for (Eigen::Index i = 0; i < n; ++i)
      columns.row(i) << 1.0, std::exp(-out.windows[static_cast<std::size_t>(i)].speed_mps / speed_mps);
    const LinearLaw law = fit_law(columns, y);
    if (!(law.value[1] > 0.0) || !(law.residual_power < best_power)) continue;
    best_power = law.residual_power;
    best = {law.value[0] + law.value[1], law.value[0], speed_mps};
    residual = y - columns * law.value;
  }
  if (std::isnan(best.speed_mps)) return;
  constexpr double kParameters = 3.0;
  const double independent = independent_count({residual.begin(), residual.end()});
  if (!(independent > kParameters)) return;
  const double evidence =
      (independent - kParameters) * std::log(about_mean.squaredNorm() / best_power) - 2.0 * std::log(independent);
  if (evidence > kEvidence) out.stribeck = best;
}

}  // namespace asperity
