#include "asperity/calibration/fit_force_line.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <fmt/format.h>
#include <Eigen/Core>

#include "asperity/algebra/solve.h"
#include "asperity/base/error.h"
#include "asperity/signal/student.h"

namespace asperity {

namespace {

const char* const kWhatToMeasure =
    "press the probe on a scale at five or more forces spread over its range, and write one line counts,force_N each";

void check_force_points(const ForcePoints& points) {
  if (points.counts.size() != points.force_N.size()) {
    throw Error(fmt::format("force points: {} counts, but {} forces", points.counts.size(), points.force_N.size()));
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!std::isfinite(points.counts[i]) || !std::isfinite(points.force_N[i])) {
      throw Error(fmt::format("force point {} is not finite", i + 1));
    }
  }
  if (points.size() < 3) {
    throw Error(fmt::format("{} force points cannot show how well a line fits: {}", points.size(), kWhatToMeasure));
  }
  for (const auto& [values, what] : {std::pair{&points.counts, "counts"}, {&points.force_N, "forces"}}) {
    const auto [low, high] = std::minmax_element(values->begin(), values->end());
    if (*low == *high) throw Error(fmt::format("all {} are {}: {}", what, *low, kWhatToMeasure));
  }
}

// Counts about their mean in units of their spread, so that powers of them are of one size.
struct Scaled {
  double mean = 0.0;
  double spread = 0.0;
  Eigen::VectorXd u;
};

Scaled scale(const std::vector<double>& counts) {
  Scaled out;
  const auto n = static_cast<double>(counts.size());
  for (const double x : counts) out.mean += x / n;
  double square = 0.0;
  for (const double x : counts) square += (x - out.mean) * (x - out.mean);
  out.spread = std::sqrt(square / n);
  out.u.resize(static_cast<Eigen::Index>(counts.size()));
  for (std::size_t i = 0; i < counts.size(); ++i) {
    out.u[static_cast<Eigen::Index>(i)] = (counts[i] - out.mean) / out.spread;
  }
  return out;
}

// Student's t-test of c in force = a + b u + c (u² − …), and how far that parabola leaves the line.
void test_bend(const Scaled& x, const Eigen::VectorXd& residual_N, ForceLineFit& fit) {
  const Eigen::Index n = x.u.size();
  if (n < 4) return;
  Eigen::MatrixXd G(n, 2);
  G.col(0).setOnes();
  G.col(1) = x.u;
  const Eigen::VectorXd square = x.u.cwiseAbs2();
  const Eigen::Vector2d below = least_squares(G, square).x;
  const Eigen::VectorXd bend = square - G * below;
  // Two distinct counts leave nothing of the square but rounding.
  const double size = bend.squaredNorm();
  if (!(size > 1e-12 * square.squaredNorm())) return;
  const double c_N = bend.dot(residual_N) / size;
  const double left_N2 = (residual_N - c_N * bend).squaredNorm();
  const auto freedom = static_cast<double>(n - 3);
  fit.bend_probability = student_two_sided(c_N * std::sqrt(size * freedom / left_N2), freedom);
  fit.bend_newton = std::abs(c_N) * bend.cwiseAbs().maxCoeff();
}

std::vector<std::size_t> find_outliers(const Scaled& x, const Eigen::VectorXd& residual_N, double significance) {
  std::vector<std::size_t> out;
  const auto n = static_cast<double>(x.u.size());
  if (n < 5.0) return out;
  const double sum_N2 = residual_N.squaredNorm();
  for (Eigen::Index i = 0; i < x.u.size(); ++i) {
    const double leverage = (1.0 + x.u[i] * x.u[i]) / n;
    const double own_N2 = residual_N[i] * residual_N[i] / (1.0 - leverage);
    const double others_N2 = (sum_N2 - own_N2) / (n - 3.0);
    if (own_N2 > 0.0 && student_two_sided(std::sqrt(own_N2 / std::max(others_N2, 0.0)), n - 3.0) < significance / n) {
      out.push_back(static_cast<std::size_t>(i));
    }
  }
  return out;
}

// Points that share the lowest or the highest counts while their forces differ by far more than neighbours' do.
std::vector<std::size_t> find_saturated(const ForcePoints& points, double share) {
  const auto [low, high] = std::minmax_element(points.counts.begin(), points.counts.end());
  const auto [least, most] = std::minmax_element(points.force_N.begin(), points.force_N.end());
  std::vector<std::size_t> out;
  for (const double end : {*low, *high}) {
    std::vector<std::size_t> there;
    double least_N = *most;
    double most_N = *least;
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (points.counts[i] != end) continue;
      there.push_back(i);
      least_N = std::min(least_N, points.force_N[i]);
      most_N = std::max(most_N, points.force_N[i]);
    }
    if (there.size() > 1 && most_N - least_N > share * (*most - *least))
      out.insert(out.end(), there.begin(), there.end());
  }
  return out;
}

// Loads that are at least `share` of the forces' span apart.
std::size_t count_loads(const ForcePoints& points, double share) {
  std::vector<double> force_N = points.force_N;
  std::sort(force_N.begin(), force_N.end());
  const double apart_N = share * (force_N.back() - force_N.front());
  std::size_t loads = 1;
  double last_N = force_N.front();
  for (const double one_N : force_N) {
    if (one_N - last_N <= apart_N) continue;
    ++loads;
    last_N = one_N;
  }
  return loads;
}

std::string places(const std::vector<std::size_t>& at) {
  std::string out;
  for (std::size_t k = 0; k < at.size() && k < 10; ++k) out += (k == 0 ? "" : ", ") + std::to_string(at[k] + 1);
  return out + (at.size() > 10 ? ", …" : "");
}

CalibrationVerdict judge_force_line(const ForceLineFit& fit, double span_N, const FitForceLineConfig& config) {
  CalibrationVerdict out;
  const double half = student_quantile(0.95, fit.degrees_of_freedom) * fit.newton_per_count_stderr /
                      std::abs(fit.force.newton_per_count);
  out.text = fmt::format(
      "A straight line fits to {:.2g} N with {} degrees of freedom; the slope is known to ±{:.1f} % "
      "(95 %).",
      fit.force.residual_newton, fit.degrees_of_freedom, 100.0 * half);
  if (!(half <= config.slope_uncertainty)) {
    out.add("force_slope_unknown", fmt::format("the slope is known to ±{:.0f} % only (95 %)", 100.0 * half));
  }
  if (!fit.saturated.empty()) {
    out.add("force_saturated",
            fmt::format("points {} share one end of the counts at different forces: the sensor is saturated there",
                        places(fit.saturated)));
  }
  if (fit.loads < 3) {
    out.add("force_few_loads", "all points are at two loads, which cannot show whether the sensor is straight");
  }
  if (fit.bend_probability < config.significance && fit.bend_newton > config.linearity_share * span_N) {
    out.add("force_not_straight", fmt::format("the sensor is not linear: a parabola deviates from the line by {:.2g} "
                                              "N, {:.1f} % of the range (probability {:.1g} by chance)",
                                              fit.bend_newton, 100.0 * fit.bend_newton / span_N, fit.bend_probability));
  }
  if (!fit.outliers.empty()) {
    out.add("force_outlier", fmt::format("point {} contradicts the others", places(fit.outliers)));
    out.text += fmt::format(" Point {} contradicts the others: measure it again.", places(fit.outliers));
  }
  if (fit.counts_error_newton > 0.5 * fit.force.residual_newton) {
    out.add("counts_coarse", "the rounding of the counts is not small compared with the residual");
    out.text += " The rounding of the counts is not small compared with the residual.";
  }
  return out;
}

}  // namespace

ForceLineFit fit_force_line(const ForcePoints& points, const FitForceLineConfig& config) {
  check_force_points(points);
  const Scaled x = scale(points.counts);
  const auto n = static_cast<double>(points.size());
  const Eigen::Map<const Eigen::VectorXd> force_N(points.force_N.data(), static_cast<Eigen::Index>(points.size()));
  const double mean_N = force_N.mean();
  const double slope_N = x.u.dot(force_N) / n;
  const Eigen::VectorXd residual_N = (force_N.array() - mean_N).matrix() - slope_N * x.u;

  ForceLineFit fit;
  fit.points = points.size();
  fit.degrees_of_freedom = static_cast<int>(points.size()) - 2;
  fit.force.newton_per_count = slope_N / x.spread;
  fit.force.offset_newton = mean_N - fit.force.newton_per_count * x.mean;
  fit.force.residual_newton = std::sqrt(residual_N.squaredNorm() / (n - 2.0));
  fit.counts_error_newton = std::abs(fit.force.newton_per_count) / std::sqrt(12.0);
  // Rounding is in every count, also where the residuals happen to show less of it.
  const double s_N = std::max(fit.force.residual_newton, fit.counts_error_newton);
  const double far = x.mean / x.spread;
  fit.newton_per_count_stderr = s_N / (x.spread * std::sqrt(n));
  fit.offset_newton_stderr = s_N * std::sqrt((1.0 + far * far) / n);
  fit.correlation = -far / std::sqrt(1.0 + far * far);
  if (fit.force.newton_per_count == 0.0) {
    throw Error(std::string("the counts do not follow the force at all: ") + kWhatToMeasure);
  }
  test_bend(x, residual_N, fit);
  fit.outliers = find_outliers(x, residual_N, config.significance);
  fit.saturated = find_saturated(points, config.saturation_share);
  fit.loads = count_loads(points, config.linearity_share);
  fit.verdict = judge_force_line(fit, force_N.maxCoeff() - force_N.minCoeff(), config);
  return fit;
}

}  // namespace asperity
