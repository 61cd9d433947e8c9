#include "asperity/profile/measure_areal_texture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include <Eigen/Core>

#include "areal_errors.h"
#include "areal_gaussian_filter.h"
#include "asperity/algebra/solve.h"
#include "asperity/base/error.h"
#include "asperity/base/plausible_profile.h"
#include "asperity/base/text.h"
#include "local_slopes.h"
#include "material_curve.h"
#include "robust_areal_filter.h"
#include "surface_direction.h"

namespace asperity {
namespace {

std::size_t check_map(const ArealMap& map, const ArealTextureConfig& config) {
  if (map.columns < 2 || map.rows < 2 || map.height_m.size() != map.columns * map.rows) {
    throw Error("areal roughness: " + std::to_string(map.height_m.size()) + " heights for a map of " +
                std::to_string(map.columns) + " by " + std::to_string(map.rows) + " points");
  }
  for (const double spacing_m : {map.x_spacing_m, map.y_spacing_m}) {
    require_plausible_spacing(spacing_m, "areal roughness");
  }
  std::size_t missing = 0;
  for (std::size_t i = 0; i < map.height_m.size(); ++i) {
    if (std::isinf(map.height_m[i])) {
      throw Error("areal roughness: the height in row " + std::to_string(i / map.columns + 1) + ", column " +
                  std::to_string(i % map.columns + 1) + " is infinite");
    }
    if (std::abs(map.height_m[i]) > kPlausibleHeight_m) {
      throw Error("areal roughness: the height in row " + std::to_string(i / map.columns + 1) + ", column " +
                  std::to_string(i % map.columns + 1) + " is " + number_text(map.height_m[i]) +
                  " m, which is not plausible");
    }
    if (std::isnan(map.height_m[i])) ++missing;
  }
  if (missing + 3 > map.height_m.size() ||
      static_cast<double>(missing) > config.max_missing * static_cast<double>(map.height_m.size())) {
    throw Error("areal roughness: " + std::to_string(missing) + " of " + std::to_string(map.height_m.size()) +
                " heights are missing; allowed is a part of " + number_text(config.max_missing));
  }
  return missing;
}

void subtract_mean(ArealMap& map) {
  double sum = 0.0, count = 0.0;
  for (const double z : map.height_m) {
    if (std::isnan(z)) continue;
    sum += z;
    count += 1.0;
  }
  for (double& z : map.height_m) z -= sum / count;
}

// Powers of the position from −1 to 1.
std::array<double, 5> powers_of(std::size_t i, std::size_t count) {
  const double x = 2.0 * static_cast<double>(i) / static_cast<double>(count - 1) - 1.0;
  return {1.0, x, x * x, x * x * x, x * x * x * x};
}

// Σ x^k and Σ x^k z over the heights of a row that are present.
struct RowMoments {
  std::array<double, 5> ones{};
  std::array<double, 3> heights{};
};

RowMoments moments_of_row(const double* z, const std::vector<std::array<double, 5>>& x) {
  RowMoments out;
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (std::isnan(z[i])) continue;
    for (std::size_t k = 0; k < out.ones.size(); ++k) out.ones[k] += x[i][k];
    for (std::size_t k = 0; k < out.heights.size(); ++k) out.heights[k] += x[i][k] * z[i];
  }
  return out;
}

// The least-squares polynomial with `terms` of 1, x, y, x², xy, y², positions from −1 to 1; its coefficients.
Eigen::VectorXd subtract_polynomial(ArealMap& map, Eigen::Index terms) {
  constexpr std::array<std::size_t, 6> kOfX{0, 1, 0, 2, 1, 0}, kOfY{0, 0, 1, 0, 1, 2};
  std::vector<std::array<double, 5>> x;
  for (std::size_t i = 0; i < map.columns; ++i) x.push_back(powers_of(i, map.columns));
  Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(terms, terms);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(terms);
  for (std::size_t row = 0; row < map.rows; ++row) {
    const RowMoments moments = moments_of_row(&map.height_m[row * map.columns], x);
    const std::array<double, 5> y = powers_of(row, map.rows);
    for (Eigen::Index t = 0; t < terms; ++t) {
      const auto a = static_cast<std::size_t>(t);
      for (Eigen::Index u = 0; u < terms; ++u) {
        const auto b = static_cast<std::size_t>(u);
        normal(t, u) += y[kOfY[a] + kOfY[b]] * moments.ones[kOfX[a] + kOfX[b]];
      }
      right[t] += y[kOfY[a]] * moments.heights[kOfX[a]];
    }
  }
  const LeastSquares fit = least_squares(normal, right);
  if (fit.rank < terms)
    throw Error("areal roughness: the heights are on one line, which does not determine a plane or a quadric");
  const Eigen::VectorXd form = fit.x.col(0);
  for (std::size_t row = 0; row < map.rows; ++row) {
    std::array<double, 3> of_x{};
    const std::array<double, 5> y = powers_of(row, map.rows);
    for (Eigen::Index t = 0; t < terms; ++t) {
      const auto a = static_cast<std::size_t>(t);
      of_x[kOfX[a]] += form[t] * y[kOfY[a]];
    }
    double* z = &map.height_m[row * map.columns];
    for (std::size_t i = 0; i < map.columns; ++i) z[i] -= of_x[0] + of_x[1] * x[i][1] + of_x[2] * x[i][2];
  }
  return form;
}

ArealMap filtered(const ArealMap& map, const ArealTextureConfig& config, ArealTextureResult& result) {
  result.samples = map.height_m.size();
  result.missing = check_map(map, config);
  ArealMap out = map;
  subtract_mean(out);
  if (config.form != ArealForm::kMean) {
    const Eigen::VectorXd form = subtract_polynomial(out, config.form == ArealForm::kPlane ? 3 : 6);
    result.slope_x = 2.0 * form[1] / (static_cast<double>(map.columns - 1) * map.x_spacing_m);
    result.slope_y = 2.0 * form[2] / (static_cast<double>(map.rows - 1) * map.y_spacing_m);
  }
  if (config.lambda_s_mm > 0.0) out = gaussian_mean_surface(out, 1e-3 * config.lambda_s_mm);
  if (config.lambda_c_mm > 0.0) {
    const double cutoff_m = 1e-3 * config.lambda_c_mm;
    const ArealMap waviness = config.filter == ArealFilter::kRobust ? robust_gaussian_mean_surface(out, cutoff_m)
                                                                    : gaussian_mean_surface(out, cutoff_m);
    for (std::size_t i = 0; i < out.height_m.size(); ++i) out.height_m[i] -= waviness.height_m[i];
  }
  subtract_mean(out);
  return out;
}

void measure_heights(const ArealMap& map, ArealTextureResult& out) {
  double sum1 = 0.0, sum2 = 0.0, sum3 = 0.0, sum4 = 0.0, high = 0.0, low = 0.0;
  for (const double z : map.height_m) {
    if (std::isnan(z)) continue;
    sum1 += std::abs(z);
    sum2 += z * z;
    sum3 += z * z * z;
    sum4 += z * z * z * z;
    high = std::max(high, z);
    low = std::min(low, z);
  }
  const double count = static_cast<double>(out.samples - out.missing);
  out.Sa_m = sum1 / count;
  out.Sq_m = std::sqrt(sum2 / count);
  out.Sp_m = high;
  out.Sv_m = -low;
  out.Sz_m = high - low;
  if (out.Sq_m == 0.0) return;
  out.Ssk = sum3 / count / std::pow(out.Sq_m, 3);
  out.Sku = sum4 / count / std::pow(out.Sq_m, 4);
}

void measure_slopes(const ArealMap& map, ArealTextureResult& out) {
  std::vector<double> along_x(map.columns), along_y(map.columns);
  double squares = 0.0, larger = 0.0, count = 0.0;
  for (std::size_t row = 0; row < map.rows; ++row) {
    local_slopes(&map.height_m[row * map.columns], map.columns, map.x_spacing_m, along_x.data());
    local_slopes_across(map.height_m.data(), map.columns, map.rows, row, map.y_spacing_m, along_y.data());
    for (std::size_t i = 0; i < map.columns; ++i) {
      const double square = along_x[i] * along_x[i] + along_y[i] * along_y[i];
      if (std::isnan(square)) continue;
      squares += square;
      larger += square / (std::sqrt(1.0 + square) + 1.0);  // √(1 + s²) − 1
      count += 1.0;
    }
  }
  if (count == 0.0) return;
  out.Sdq = std::sqrt(squares / count);
  out.Sdr = larger / count;
}

void measure_material(const ArealMap& map, ArealTextureResult& out) {
  const MaterialCurve curve(map.height_m);
  const MaterialCore core = curve.core();
  out.Sk_m = core.k;
  out.Spk_m = core.pk;
  out.Svk_m = core.vk;
  out.Smrk1 = core.ratio1;
  out.Smrk2 = core.ratio2;
  out.Sxp_m = curve.level(0.025) - curve.level(0.5);
  constexpr double kPeaks = 0.1, kPits = 0.8;  // the defaults of ISO 25178-3
  out.Vmp_m = curve.material_volume(kPeaks);
  out.Vmc_m = curve.material_volume(kPits) - out.Vmp_m;
  out.Vvv_m = curve.void_volume(kPits);
  out.Vvc_m = curve.void_volume(kPeaks) - out.Vvv_m;
}

void measure_direction(const ArealMap& map, ArealTextureResult& out) {
  if (!(out.Sq_m > 0.0)) return;
  constexpr double kMostStr = 0.5;  // above it the surface has no lay whose direction means something
  const CorrelationLengths lengths = correlation_lengths(map);
  out.Sal_m = lengths.shortest_m;
  out.Str = lengths.shortest_m / lengths.longest_m;
  if (!(out.Str > kMostStr) && !std::isnan(lengths.shortest_m)) out.Std_rad = lay_direction_rad(map);
}

}  // namespace

ArealMap filter_surface(const ArealMap& map, const ArealTextureConfig& config) {
  ArealTextureResult unused;
  return filtered(map, config, unused);
}

ArealTextureResult measure_areal_texture(const ArealMap& map, const ArealTextureConfig& config,
                                         const ArealNoise& noise) {
  ArealTextureResult out;
  const ArealMap surface = filtered(map, config, out);
  measure_heights(surface, out);
  measure_slopes(surface, out);
  measure_material(surface, out);
  measure_direction(surface, out);
  if (noise.is_known()) take_areal_errors(map, config, noise, out);
  return out;
}

}  // namespace asperity
