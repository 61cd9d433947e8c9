#include "blurred_pattern.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace asperity {
namespace {

constexpr double kReach = 4.0;  // standard deviations beyond which nothing is seen: 3e-5 of the contrast
constexpr int kSteps = 32;      // per standard deviation
constexpr int kMostCells = 16;  // that one spread reaches over

// The normal distribution and its density at the table's places.
struct NormalTable {
  std::array<double, static_cast<std::size_t>(2 * kReach) * kSteps + 2> cdf, pdf;
  NormalTable() {
    for (std::size_t i = 0; i < cdf.size(); ++i) {
      const double x = -kReach + static_cast<double>(i) / kSteps;
      cdf[i] = 0.5 * std::erfc(-x * std::numbers::sqrt2 / 2.0);
      pdf[i] = std::exp(-0.5 * x * x) / std::sqrt(2.0 * std::numbers::pi);
    }
  }
};

struct Normal {
  double cdf, pdf;
};

// By cubic Hermite polynomials between the table's places: within 1e-8.
const NormalTable kNormalTable;

Normal normal(double x) {
  const NormalTable& table = kNormalTable;
  if (x <= -kReach) return {0.0, 0.0};
  if (x >= kReach) return {1.0, 0.0};
  const double at = (x + kReach) * kSteps;
  const auto i = static_cast<std::size_t>(at);
  const double t = at - static_cast<double>(i);
  constexpr double kStep = 1.0 / kSteps;
  const double x0 = -kReach + static_cast<double>(i) * kStep;
  const auto hermite = [t](double f0, double d0, double f1, double d1) {
    const double difference = f1 - f0;
    return f0 + t * (d0 + t * (3.0 * difference - 2.0 * d0 - d1 + t * (d0 + d1 - 2.0 * difference)));
  };
  const double p0 = table.pdf[i], p1 = table.pdf[i + 1];
  return {hermite(table.cdf[i], p0 * kStep, table.cdf[i + 1], p1 * kStep),
          hermite(p0, -x0 * p0 * kStep, p1, -(x0 + kStep) * p1 * kStep)};
}

// std::floor is a call on processors of the least kind; x is within the int's range.
int floor_int(double x) {
  const int i = static_cast<int>(x);
  return i - (x < i ? 1 : 0);
}

// How much each cell of a row counts at `u`, and its derivatives.
struct Shares {
  int first = 0, count = 0;
  std::array<double, kMostCells> share, by_u, by_sigma;
};

void find_shares(double u, double sigma, int cells, Shares& out) {
  const double reach = std::min(kReach * sigma, 0.5 * kMostCells - 1.0);
  out.first = std::clamp(floor_int(u - reach), 0, cells - 1);
  const int last = std::clamp(floor_int(u + reach), 0, cells - 1);
  out.count = last - out.first + 1;
  double before = 0.0, before_by_u = 0.0, before_by_sigma = 0.0;  // of the edge on the left, at first −∞
  const double inverse = 1.0 / sigma;
  for (int i = 0; i < out.count; ++i) {
    const auto k = static_cast<std::size_t>(i);
    double after = 1.0, after_by_u = 0.0, after_by_sigma = 0.0;
    if (i + 1 < out.count) {
      const double x = (out.first + i + 1 - u) * inverse;
      const Normal edge = normal(x);
      after = edge.cdf;
      after_by_u = -edge.pdf * inverse;
      after_by_sigma = -edge.pdf * x * inverse;
    }
    out.share[k] = after - before;
    out.by_u[k] = after_by_u - before_by_u;
    out.by_sigma[k] = after_by_sigma - before_by_sigma;
    before = after;
    before_by_u = after_by_u;
    before_by_sigma = after_by_sigma;
  }
}

}  // namespace

BlurredValue blurred_pattern(const TagPattern& pattern, double u, double v, double sigma_u, double sigma_v,
                             double covariance) {
  // A place beyond all bounds, or none: a step of the fit that will not be accepted.
  constexpr double kFar_cells = 1e6;
  if (!(std::abs(u) + std::abs(v) + sigma_u + sigma_v < kFar_cells)) return {};
  Shares columns, rows;
  find_shares(u, sigma_u, pattern.cells, columns);
  find_shares(v, sigma_v, pattern.cells, rows);
  BlurredValue out;
  double by_uv = 0.0, by_sigmas = 0.0;
  for (int j = 0; j < rows.count; ++j) {
    double value = 0.0, by_u = 0.0, by_sigma = 0.0;
    const std::uint8_t* const white = pattern.white.data() + (rows.first + j) * pattern.cells + columns.first;
    for (int i = 0; i < columns.count; ++i) {
      if (white[i] == 0) continue;
      const auto k = static_cast<std::size_t>(i);
      value += columns.share[k];
      by_u += columns.by_u[k];
      by_sigma += columns.by_sigma[k];
    }
    const auto k = static_cast<std::size_t>(j);
    out.value += rows.share[k] * value;
    out.by_u += rows.share[k] * by_u;
    out.by_sigma_u += rows.share[k] * by_sigma;
    out.by_v += rows.by_u[k] * value;
    out.by_sigma_v += rows.by_sigma[k] * value;
    by_uv += rows.by_u[k] * by_u;
    by_sigmas += rows.by_sigma[k] * by_sigma;
  }
  // ∂²/∂u² is 1/σ ∂/∂σ.
  const double by_uuvv = by_sigmas / (sigma_u * sigma_v);
  out.value += covariance * (by_uv + 0.5 * covariance * by_uuvv);
  out.by_covariance = by_uv + covariance * by_uuvv;
  return out;
}

}  // namespace asperity
