#include "robust_gaussian_filter.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "asperity/base/error.h"
#include "asperity/base/nan.h"
#include "asperity/base/text.h"
#include "biweight.h"

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

std::vector<double> robust_gaussian_mean_line_m(std::span<const double> height_m, double spacing_m, double cutoff_m) {
  if (!(spacing_m > 0.0) || !std::isfinite(spacing_m))
    throw Error("the spacing " + number_text(spacing_m) + " m is not a positive length");
  if (!(cutoff_m > 0.0) || !std::isfinite(cutoff_m))
    throw Error("the cut-off " + number_text(cutoff_m) + " m is not a positive length");
  constexpr double kAlpha = 0.7309134280946760;  // √((ln 2 / π) · 1.67834699 / ln 2), (1 + u) e^−u = 1/2
  constexpr int kMostIterations = 30;
  constexpr double kTolerance = 1e-4;
  const auto n = static_cast<std::ptrdiff_t>(height_m.size());
  // Where the weight has fallen to 1e-6.
  const double reach_m = kAlpha * cutoff_m * std::sqrt(std::log(1e6) / std::numbers::pi);
  const auto reach = static_cast<std::ptrdiff_t>(std::min(std::ceil(reach_m / spacing_m), static_cast<double>(n)));
  std::vector<double> weight(static_cast<std::size_t>(reach) + 1);
  for (std::size_t k = 0; k < weight.size(); ++k) {
    const double x = static_cast<double>(k) * spacing_m / (kAlpha * cutoff_m);
    weight[k] = std::exp(-std::numbers::pi * x * x);
  }

  std::vector<double> line_m(height_m.size(), kNan), trust(height_m.size());
  for (std::size_t i = 0; i < trust.size(); ++i) trust[i] = std::isnan(height_m[i]) ? 0.0 : 1.0;
  double scale_m = 0.0;
  for (int iteration = 0; iteration < kMostIterations; ++iteration) {
    std::vector<double> residual_m;
    residual_m.reserve(height_m.size());
    for (std::ptrdiff_t i = 0; i < n; ++i) {
      const auto at = static_cast<std::size_t>(i);
      if (std::isnan(height_m[at])) continue;
      std::array<double, 5> m{};
      std::array<double, 3> t{};
      for (std::ptrdiff_t j = std::max<std::ptrdiff_t>(0, i - reach); j <= std::min(n - 1, i + reach); ++j) {
        const auto other = static_cast<std::size_t>(j);
        if (trust[other] == 0.0) continue;
        const double w = trust[other] * weight[static_cast<std::size_t>(std::abs(j - i))];
        const double x = static_cast<double>(j - i) / static_cast<double>(reach + 1);
        const double wx = w * x, wxx = wx * x, z = height_m[other];
        m[0] += w, m[1] += wx, m[2] += wxx, m[3] += wxx * x, m[4] += wxx * x * x;
        t[0] += w * z, t[1] += wx * z, t[2] += wxx * z;
      }
      const double value = parabola_at_zero(m, t);
      if (!std::isnan(value)) line_m[at] = value;  // none left in reach: the line of the last iteration stays
      residual_m.push_back(std::abs(height_m[at] - line_m[at]));
    }
    const double before_m = scale_m;
    scale_m = biweight_limit(std::move(residual_m));
    if (!(scale_m > 0.0) || std::abs(scale_m - before_m) <= kTolerance * scale_m) break;
    for (std::size_t i = 0; i < trust.size(); ++i) {
      if (std::isnan(height_m[i])) continue;
      trust[i] = biweight(height_m[i] - line_m[i], scale_m);
    }
  }
  return line_m;
}

}  // namespace asperity
