#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>
#include <Eigen/Core>
#include <Eigen/QR>

#include "asperity/base/nan.h"
#include "asperity/base/random.h"
#include "robust_areal_filter.h"
#include "robust_gaussian_filter.h"

namespace asperity {
namespace {

// The definition: at every sample least squares of a parabola by orthogonal decomposition, with Tukey's weights; no
// moments, no transforms. The last line stays where no sample in reach is trusted.
std::vector<double> line_by_definition(const std::vector<double>& z, double spacing_m, double cutoff_m) {
  const double width_m = 0.7309134280946760 * cutoff_m;
  const auto n = static_cast<Eigen::Index>(z.size());
  const auto reach = static_cast<Eigen::Index>(std::ceil(2.1289340388624525 * width_m / spacing_m));
  std::vector<double> line(z.size(), kNan), trust(z.size(), 1.0);
  double scale = 0.0;
  for (int iteration = 0; iteration < 30; ++iteration) {
    std::vector<double> residuals;
    for (Eigen::Index i = 0; i < n; ++i) {
      const Eigen::Index first = std::max<Eigen::Index>(0, i - reach), last = std::min(n - 1, i + reach);
      Eigen::MatrixXd A(last - first + 1, 3);
      Eigen::VectorXd b(A.rows());
      double sum = 0.0;
      for (Eigen::Index j = first; j <= last; ++j) {
        const double x = static_cast<double>(j - i) * spacing_m / width_m, t = trust[static_cast<std::size_t>(j)];
        const double w = std::sqrt(t * std::exp(-std::numbers::pi * x * x));
        A.row(j - first) << w, w * x, w * x * x;
        b[j - first] = w * z[static_cast<std::size_t>(j)];
        sum += t;
      }
      const auto at = static_cast<std::size_t>(i);
      if (sum > 0.0) line[at] = A.colPivHouseholderQr().solve(b)[0];
      residuals.push_back(std::abs(z[at] - line[at]));
    }
    std::sort(residuals.begin(), residuals.end());
    const double before = scale;
    scale = 4.4478 * residuals[residuals.size() / 2];
    if (!(scale > 0.0) || std::abs(scale - before) <= 1e-4 * scale) break;
    for (std::size_t i = 0; i < z.size(); ++i) {
      const double r = (z[i] - line[i]) / scale;
      trust[i] = std::abs(r) < 1.0 ? (1.0 - r * r) * (1.0 - r * r) : 0.0;
    }
  }
  return line;
}

// A rough stretch as wide as the weight reaches, of which nothing is trusted: the sums are done by transforms, whose
// rounding there is larger than the sums.
TEST(RobustFilters, AStretchWithoutTrustIsAsByTheDefinition) {
  Random random(4);
  std::vector<double> z;
  for (int i = 0; i < 900; ++i) z.push_back(i > 350 && i < 600 ? random.uniform(0.0, 20e-6) : 1e-9 * random.normal());
  constexpr double kSpacing_m = 1e-6, kCutoff_m = 50e-6;  // 107 samples to either side
  const std::vector<double> line = robust_gaussian_mean_line_m(z, kSpacing_m, kCutoff_m);
  const std::vector<double> want = line_by_definition(z, kSpacing_m, kCutoff_m);
  for (std::size_t i = 0; i < z.size(); ++i) {
    EXPECT_LT(std::abs(line[i]), 40e-6) << i;  // within twice the heights' range
    // Where samples within a weight's width are trusted the two agree; deep in the stretch a parabola is extrapolated
    // from the far ends of the weight, where the one is cut at 1e-6 and the other at 7e-7.
    if (i < 240 || i > 710) {
      EXPECT_NEAR(line[i], want[i], 1e-10) << i;  // a tenth of the noise: the iteration ends at 1e-4 of the limit
    }
  }
}

// Exact zeros with pits: the distances become rounding, and no weight that is made of them means anything.
TEST(RobustFilters, ZerosWithPitsStayZeros) {
  std::vector<double> z;
  for (int i = 0; i < 6000; ++i) z.push_back(i % 600 >= 270 && i % 600 < 330 ? -5e-6 : 0.0);
  for (const double cutoff_m : {42e-6, 100e-6, 250e-6, 800e-6}) {  // from 90 samples to either side on
    for (const double line_m : robust_gaussian_mean_line_m(z, 1e-6, cutoff_m)) {
      EXPECT_LT(std::abs(line_m), 1e-12) << cutoff_m;
    }
  }
  ArealMap map{1e-6, 1e-6, 180, 180, {}};
  for (int row = 0; row < 180; ++row)
    for (int column = 0; column < 180; ++column)
      map.height_m.push_back(row % 45 < 12 && column % 45 < 12 ? -5e-6 : 0.0);
  for (const double cutoff_m : {40e-6, 60e-6, 90e-6}) {
    for (const double z_m : robust_gaussian_mean_surface(map, cutoff_m).height_m) EXPECT_LT(std::abs(z_m), 0.5e-6);
  }
}

}  // namespace
}  // namespace asperity
