#include "robust_areal_filter.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <vector>

#include <Eigen/Cholesky>
#include <Eigen/Core>

#include "asperity/base/error.h"
#include "asperity/base/nan.h"
#include "asperity/base/text.h"
#include "biweight.h"
#include "gaussian_moments.h"

namespace asperity {
namespace {

using Vector6d = Eigen::Matrix<double, 6, 1>;
using Matrix6d = Eigen::Matrix<double, 6, 6>;

struct Power {
  std::size_t x, y;
};
// Of the quadric's terms: 1, x, y, x², xy, y².
constexpr std::array<Power, 6> kTerms{{{0, 0}, {1, 0}, {0, 1}, {2, 0}, {1, 1}, {0, 2}}};
constexpr std::size_t kHighest = 4;  // of the moments: products of two terms

// Weighted least squares of the first `terms` at x = y = 0; nan where the heights do not fix them.
template <int Terms>
double fitted_at_zero(const Matrix6d& normal, const Vector6d& right) {
  const Eigen::LDLT<Eigen::Matrix<double, Terms, Terms>> factor(normal.topLeftCorner<Terms, Terms>());
  constexpr double kFixed = 1e-9;
  if (!(factor.vectorD().minCoeff() > kFixed * normal(0, 0))) return kNan;
  return factor.solve(right.head<Terms>())[0];
}

double quadric_at_zero(const Matrix6d& normal, const Vector6d& right) {
  if (!(normal(0, 0) > 0.0)) return kNan;
  const double quadric = fitted_at_zero<6>(normal, right);
  if (!std::isnan(quadric)) return quadric;
  const double plane = fitted_at_zero<3>(normal, right);
  return std::isnan(plane) ? right[0] / normal(0, 0) : plane;
}

// Moments in two dimensions, rows first; x^a summed along a row is kept column by column.
class ArealMoments {
 public:
  ArealMoments(const ArealMap& map, double width_m) : columns_(map.columns), rows_(map.rows) {
    for (std::size_t degree = 0; degree <= kHighest; ++degree) {
      along_x_.emplace_back(columns_, map.x_spacing_m, width_m, static_cast<int>(degree));
      along_y_.emplace_back(rows_, map.y_spacing_m, width_m, static_cast<int>(degree));
    }
  }

  // The mean surface of heights with weights, 0 where there is none.
  std::vector<double> mean_surface(const std::vector<double>& weight, const std::vector<double>& height_m) const {
    constexpr std::size_t kOfHeights = 3;  // powers of x
    std::vector<std::vector<double>> of_weights(kHighest + 1), of_heights(kOfHeights);
    std::vector<double> weighted(weight.size());
    for (std::size_t i = 0; i < weight.size(); ++i) weighted[i] = weight[i] > 0.0 ? weight[i] * height_m[i] : 0.0;
    for (std::size_t a = 0; a <= kHighest; ++a) of_weights[a] = along_rows(weight, a);
    for (std::size_t a = 0; a < kOfHeights; ++a) of_heights[a] = along_rows(weighted, a);
    const bool by_transforms = along_x_[0].by_transforms() || along_y_[0].by_transforms();
    const double little = kLittleTrust * along_x_[0].total() * along_y_[0].total();
    std::vector<double> out(weight.size(), kNan);
    for (std::size_t column = 0; column < columns_; ++column) {
      std::array<std::array<std::vector<double>, kHighest + 1>, kHighest + 1> moment;
      for (std::size_t a = 0; a <= kHighest; ++a) {
        for (std::size_t b = 0; a + b <= kHighest; ++b) moment[a][b] = along_column(of_weights[a], column, b);
      }
      std::array<std::vector<double>, 6> heights;
      for (std::size_t t = 0; t < heights.size(); ++t)
        heights[t] = along_column(of_heights[kTerms[t].x], column, kTerms[t].y);
      for (std::size_t row = 0; row < rows_; ++row) {
        Matrix6d normal;
        Vector6d right;
        if (by_transforms && moment[0][0][row] < little) {
          sum_directly(weight, height_m, row, column, normal, right);
        } else {
          for (std::size_t t = 0; t < kTerms.size(); ++t) {
            right[static_cast<Eigen::Index>(t)] = heights[t][row];
            for (std::size_t s = 0; s < kTerms.size(); ++s)
              normal(static_cast<Eigen::Index>(t), static_cast<Eigen::Index>(s)) =
                  moment[kTerms[t].x + kTerms[s].x][kTerms[t].y + kTerms[s].y][row];
          }
        }
        out[row * columns_ + column] = quadric_at_zero(normal, right);
      }
    }
    return out;
  }

 private:
  // The normal equations of one point by the sums themselves.
  void sum_directly(const std::vector<double>& weight, const std::vector<double>& height_m, std::size_t row,
                    std::size_t column, Matrix6d& normal, Vector6d& right) const {
    normal.setZero();
    right.setZero();
    const std::size_t reach_x = along_x_[0].reach(), reach_y = along_y_[0].reach();
    const std::size_t first_row = row - std::min(row, reach_y), last_row = std::min(row + reach_y, rows_ - 1);
    const std::size_t first = column - std::min(column, reach_x), last = std::min(column + reach_x, columns_ - 1);
    for (std::size_t r = first_row; r <= last_row; ++r) {
      for (std::size_t c = first; c <= last; ++c) {
        const double trust = weight[r * columns_ + c];
        if (!(trust > 0.0)) continue;
        Vector6d terms;
        const std::size_t kx = c + reach_x - column, ky = r + reach_y - row;
        const double w = trust * along_x_[0].kernel(kx) * along_y_[0].kernel(ky);
        const double x = along_x_[1].kernel(kx) / along_x_[0].kernel(kx),
                     y = along_y_[1].kernel(ky) / along_y_[0].kernel(ky);
        terms << 1.0, x, y, x * x, x * y, y * y;
        normal += w * terms * terms.transpose();
        right += w * height_m[r * columns_ + c] * terms;
      }
    }
  }

  std::vector<double> along_rows(const std::vector<double>& v, std::size_t degree) const {
    std::vector<double> out(v.size());
    for (std::size_t row = 0; row < rows_; ++row) {
      const std::vector<double> line = along_x_[degree].of(std::span(v).subspan(row * columns_, columns_));
      for (std::size_t column = 0; column < columns_; ++column) out[column * rows_ + row] = line[column];
    }
    return out;
  }

  std::vector<double> along_column(const std::vector<double>& v, std::size_t column, std::size_t degree) const {
    return along_y_[degree].of(std::span(v).subspan(column * rows_, rows_));
  }

  std::size_t columns_, rows_;
  std::vector<GaussianMoments> along_x_, along_y_;
};

}  // namespace

ArealMap robust_gaussian_mean_surface(const ArealMap& map, double cutoff_m) {
  if (!(cutoff_m > 0.0) || !std::isfinite(cutoff_m))
    throw Error("the cut-off " + number_text(cutoff_m) + " m is not a positive length");
  constexpr double kAlpha = 0.7309134280946760;  // as of the profile's filter
  constexpr int kMostIterations = 30;
  constexpr double kTolerance = 1e-4;
  const ArealMoments moments(map, kAlpha * cutoff_m);
  const std::size_t n = map.height_m.size();
  std::vector<double> trust(n);
  for (std::size_t i = 0; i < n; ++i) trust[i] = std::isnan(map.height_m[i]) ? 0.0 : 1.0;
  ArealMap out = map;
  std::fill(out.height_m.begin(), out.height_m.end(), kNan);
  const double least_m = least_biweight_limit(map.height_m);
  double scale_m = 0.0;
  std::size_t trusted = 0, trusted_before = 0;
  for (int iteration = 0; iteration < kMostIterations; ++iteration) {
    const std::vector<double> mean_m = moments.mean_surface(trust, map.height_m);
    std::vector<double> residual_m;
    residual_m.reserve(n);
    for (std::size_t i = 0; i < n; ++i) {
      if (std::isnan(map.height_m[i])) continue;
      if (!std::isnan(mean_m[i])) out.height_m[i] = mean_m[i];  // none left in reach: the last one's stays
      residual_m.push_back(std::abs(map.height_m[i] - out.height_m[i]));
    }
    const double before_m = scale_m;
    scale_m = std::max(biweight_limit(std::move(residual_m)), least_m);
    const bool settled = std::abs(scale_m - before_m) <= kTolerance * scale_m;
    if (!(scale_m > 0.0) || (settled && (scale_m > least_m || trusted == trusted_before))) break;
    trusted_before = trusted;
    trusted = 0;
    for (std::size_t i = 0; i < n; ++i) {
      if (std::isnan(map.height_m[i])) continue;
      trust[i] = biweight(map.height_m[i] - out.height_m[i], scale_m);
      trusted += trust[i] > 0.0 ? 1 : 0;
    }
  }
  return out;
}

}  // namespace asperity
