#include "areal_gaussian_filter.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>
#include <vector>

#include "asperity/base/error.h"
#include "asperity/base/nan.h"
#include "asperity/base/text.h"
#include "gaussian_moments.h"

namespace asperity {
namespace {

// At x = y = 0 the plane with the moments m_ab = Σ w x^a y^b and t_ab = Σ w x^a y^b z.
double plane_at_zero(double m00, double m10, double m01, double m20, double m11, double m02, double t00, double t10,
                     double t01) {
  const double a = m20 * m02 - m11 * m11, b = m01 * m11 - m10 * m02, c = m10 * m11 - m20 * m01;
  const double determinant = m00 * a + m10 * b + m01 * c;
  if (determinant <= 1e-9 * m00 * m20 * m02) return t00 / m00;
  return (a * t00 + b * t10 + c * t01) / determinant;
}

}  // namespace

ArealMap gaussian_mean_surface(const ArealMap& map, double cutoff_m) {
  if (!(cutoff_m > 0.0) || !std::isfinite(cutoff_m))
    throw Error("the cut-off " + number_text(cutoff_m) + " m is not a positive length");
  const std::size_t columns = map.columns, rows = map.rows;
  const double width_m = std::sqrt(std::numbers::ln2 / std::numbers::pi) * cutoff_m;
  std::array<GaussianMoments, 3> along_x{GaussianMoments(columns, map.x_spacing_m, width_m, 0),
                                         GaussianMoments(columns, map.x_spacing_m, width_m, 1),
                                         GaussianMoments(columns, map.x_spacing_m, width_m, 2)};
  std::array<GaussianMoments, 3> along_y{GaussianMoments(rows, map.y_spacing_m, width_m, 0),
                                         GaussianMoments(rows, map.y_spacing_m, width_m, 1),
                                         GaussianMoments(rows, map.y_spacing_m, width_m, 2)};
  // Rows first: moments of degree 0, 1, 2 of what is present, and 0, 1 of the heights, column by column.
  std::array<std::vector<double>, 5> moments;
  for (auto& one : moments) one.resize(columns * rows);
  std::vector<double> present(columns), height(columns);
  constexpr std::size_t kTogether = 16;  // rows, so that what is written of a column is written at once
  std::array<std::vector<double>, kTogether> lines;
  for (std::size_t first = 0; first < rows; first += kTogether) {
    const std::size_t count = std::min(kTogether, rows - first);
    for (std::size_t k = 0; k < moments.size(); ++k) {
      for (std::size_t r = 0; r < count; ++r) {
        for (std::size_t column = 0; column < columns; ++column) {
          const double z = map.at(first + r, column);
          present[column] = std::isnan(z) ? 0.0 : 1.0;
          height[column] = std::isnan(z) ? 0.0 : z;
        }
        lines[r] = k < 3 ? along_x[k].of(present) : along_x[k - 3].of(height);
      }
      for (std::size_t column = 0; column < columns; ++column)
        for (std::size_t r = 0; r < count; ++r) moments[k][column * rows + first + r] = lines[r][column];
    }
  }
  ArealMap out = map;
  std::array<std::vector<double>, kTogether> mean;  // of columns, which are written together too
  for (std::size_t first = 0; first < columns; first += kTogether) {
    const std::size_t count = std::min(kTogether, columns - first);
    for (std::size_t c = 0; c < count; ++c) {
      const auto of = [&](std::size_t x_degree, std::size_t y_degree, bool heights) {
        const auto& all = moments[x_degree + (heights ? 3 : 0)];
        return along_y[y_degree].of(std::span(all).subspan((first + c) * rows, rows));
      };
      const auto m00 = of(0, 0, false), m10 = of(1, 0, false), m01 = of(0, 1, false), m20 = of(2, 0, false),
                 m11 = of(1, 1, false), m02 = of(0, 2, false), t00 = of(0, 0, true), t10 = of(1, 0, true),
                 t01 = of(0, 1, true);
      mean[c].resize(rows);
      for (std::size_t row = 0; row < rows; ++row)
        mean[c][row] =
            plane_at_zero(m00[row], m10[row], m01[row], m20[row], m11[row], m02[row], t00[row], t10[row], t01[row]);
    }
    for (std::size_t row = 0; row < rows; ++row) {
      for (std::size_t c = 0; c < count; ++c) {
        double& z = out.height_m[row * columns + first + c];
        if (!std::isnan(z)) z = mean[c][row];
      }
    }
  }
  return out;
}

}  // namespace asperity
