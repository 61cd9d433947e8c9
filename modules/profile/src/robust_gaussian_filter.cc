#include "robust_gaussian_filter.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "asperity/base/error.h"
#include "asperity/base/nan.h"
#include "asperity/base/text.h"
#include "biweight.h"
#include "gaussian_moments.h"

namespace asperity {
namespace {

// Value at x = 0 of the weighted least-squares parabola with the moments m_k = Σ w x^k and t_k = Σ w x^k z; of lower
// degree where the samples do not fix one.
double parabola_at_zero(const std::array<double, 5>& m, const std::array<double, 3>& t) {
  const double a = m[2] * m[4] - m[3] * m[3], b = m[2] * m[3] - m[1] * m[4], c = m[1] * m[3] - m[2] * m[2];
  const double determinant = m[0] * a + m[1] * b + m[2] * c;
  if (determinant > 1e-9 * m[0] * m[2] * m[4]) return (a * t[0] + b * t[1] + c * t[2]) / determinant;
  const double line = m[0] * m[2] - m[1] * m[1];
  if (line > 1e-9 * m[0] * m[2]) return (m[2] * t[0] - m[1] * t[1]) / line;
  return m[0] > 0.0 ? t[0] / m[0] : kNan;
}

}  // namespace

std::vector<double> robust_gaussian_mean_line_m(std::span<const double> height_m, double spacing_m, double cutoff_m,
                                                const Observer& observer) {
  if (!(spacing_m > 0.0) || !std::isfinite(spacing_m))
    throw Error("the spacing " + number_text(spacing_m) + " m is not a positive length");
  if (!(cutoff_m > 0.0) || !std::isfinite(cutoff_m))
    throw Error("the cut-off " + number_text(cutoff_m) + " m is not a positive length");
  constexpr double kAlpha = 0.7309134280946760;  // √((ln 2 / π) · 1.67834699 / ln 2), (1 + u) e^−u = 1/2
  constexpr int kMostIterations = 30;
  constexpr double kTolerance = 1e-4;
  const std::size_t n = height_m.size();
  std::vector<GaussianMoments> moments;
  for (int degree = 0; degree <= 4; ++degree) {
    observer.update("filter", 0.0);
    moments.emplace_back(n, spacing_m, kAlpha * cutoff_m, degree);
  }

  std::vector<double> line_m(height_m.size(), kNan), trust(height_m.size());
  for (std::size_t i = 0; i < trust.size(); ++i) trust[i] = std::isnan(height_m[i]) ? 0.0 : 1.0;
  const double least_m = least_biweight_limit(height_m);
  double scale_m = 0.0;
  std::size_t trusted = 0, trusted_before = 0;
  const auto moment = [&](std::size_t k, const std::vector<double>& of) {
    observer.update("filter", 0.0);
    return moments[k].of(of);
  };
  for (int iteration = 0; iteration < kMostIterations; ++iteration) {
    std::vector<double> weighted_m(n);
    for (std::size_t i = 0; i < n; ++i) weighted_m[i] = trust[i] > 0.0 ? trust[i] * height_m[i] : 0.0;
    std::array<std::vector<double>, 5> m;
    std::array<std::vector<double>, 3> t;
    for (std::size_t k = 0; k < m.size(); ++k) m[k] = moment(k, trust);
    for (std::size_t k = 0; k < t.size(); ++k) t[k] = moment(k, weighted_m);
    if (moments[0].by_transforms()) {
      const double little = kLittleTrust * moments[0].total();
      for (std::size_t i = 0; i < n; ++i) {
        if (m[0][i] >= little || std::isnan(height_m[i])) continue;
        for (std::size_t k = 0; k < m.size(); ++k) m[k][i] = moments[k].at(trust, i);
        for (std::size_t k = 0; k < t.size(); ++k) t[k][i] = moments[k].at(weighted_m, i);
      }
    }
    std::vector<double> residual_m;
    residual_m.reserve(n);
    for (std::size_t i = 0; i < n; ++i) {
      if (std::isnan(height_m[i])) continue;
      const double value = parabola_at_zero({m[0][i], m[1][i], m[2][i], m[3][i], m[4][i]}, {t[0][i], t[1][i], t[2][i]});
      if (!std::isnan(value)) line_m[i] = value;  // none left in reach: the line of the last iteration stays
      residual_m.push_back(std::abs(height_m[i] - line_m[i]));
    }
    const double before_m = scale_m;
    scale_m = std::max(biweight_limit(std::move(residual_m)), least_m);
    const bool settled = std::abs(scale_m - before_m) <= kTolerance * scale_m;
    if (!(scale_m > 0.0) || (settled && (scale_m > least_m || trusted == trusted_before))) break;
    trusted_before = trusted;
    trusted = 0;
    for (std::size_t i = 0; i < trust.size(); ++i) {
      if (std::isnan(height_m[i])) continue;
      trust[i] = biweight(height_m[i] - line_m[i], scale_m);
      trusted += trust[i] > 0.0 ? 1 : 0;
    }
  }
  return line_m;
}

}  // namespace asperity
