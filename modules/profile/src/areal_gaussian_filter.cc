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

constexpr std::size_t kTogether = 16;  // lines, so that what is written of a column is written at once

using Moments = std::array<GaussianMoments, 3>;  // of degree 0, 1 and 2

Moments moments_along(std::size_t count, double spacing_m, double width_m) {
  return {GaussianMoments(count, spacing_m, width_m, 0), GaussianMoments(count, spacing_m, width_m, 1),
          GaussianMoments(count, spacing_m, width_m, 2)};
}

// Of a line without gaps the weight is whole, and its first moment 0, but for `edge` points at either end.
struct WholeLine {
  WholeLine(const Moments& along, std::size_t count) : edge(std::min(along[0].reach(), count)) {
    const std::vector<double> ones(count, 1.0);
    for (std::size_t k = 0; k < along.size(); ++k) of_ones[k] = along[k].of(ones);
    for (std::size_t i = edge; i + edge < count; ++i) of_ones[1][i] = 0.0;
  }
  bool is_edge(std::size_t i) const { return i < edge || i + edge >= of_ones[0].size(); }
  std::size_t edges() const { return std::min(2 * edge, of_ones[0].size()); }
  // Of an edge point, from 0 on.
  std::size_t edge_number(std::size_t i) const { return i < edge ? i : i + edges() - of_ones[0].size(); }

  // The first moment of `line` at the edges; elsewhere any number.
  std::vector<double> first_moment(const GaussianMoments& moments, std::span<const double> line) const {
    if (moments.by_transforms()) return moments.of(line);
    std::vector<double> out(line.size(), 0.0);
    for (std::size_t i = 0; i < line.size(); ++i)
      if (is_edge(i)) out[i] = moments.at(line, i);
    return out;
  }

  std::array<std::vector<double>, 3> of_ones;
  std::size_t edge;
};

// Of a map without gaps the moments of the weight are products of those along x and along y, and those of the heights
// that are not of degree 0 count at the edges alone.
ArealMap whole_mean_surface(const ArealMap& map, const Moments& along_x, const Moments& along_y) {
  const std::size_t columns = map.columns, rows = map.rows;
  const WholeLine x(along_x, columns), y(along_y, rows);
  // Column by column; of degree 1 along x those of the edges alone.
  std::vector<double> mean_x(columns * rows), first_x(x.edges() * rows);
  for (std::size_t begin = 0; begin < rows; begin += kTogether) {
    const std::size_t count = std::min(kTogether, rows - begin);
    std::array<std::vector<double>, kTogether> means, firsts;
    for (std::size_t r = 0; r < count; ++r) {
      const std::span<const double> line(&map.height_m[(begin + r) * columns], columns);
      means[r] = along_x[0].of(line);
      firsts[r] = x.first_moment(along_x[1], line);
    }
    for (std::size_t column = 0; column < columns; ++column) {
      for (std::size_t r = 0; r < count; ++r) mean_x[column * rows + begin + r] = means[r][column];
      for (std::size_t r = 0; x.is_edge(column) && r < count; ++r)
        first_x[x.edge_number(column) * rows + begin + r] = firsts[r][column];
    }
  }
  ArealMap out = map;
  for (std::size_t begin = 0; begin < columns; begin += kTogether) {
    const std::size_t count = std::min(kTogether, columns - begin);
    std::array<std::vector<double>, kTogether> t00, t01, t10;
    for (std::size_t c = 0; c < count; ++c) {
      const std::size_t at = (begin + c) * rows;
      t00[c] = along_y[0].of(std::span(mean_x).subspan(at, rows));
      t01[c] = y.first_moment(along_y[1], std::span(mean_x).subspan(at, rows));
      t10[c] = x.is_edge(begin + c) ? along_y[0].of(std::span(first_x).subspan(x.edge_number(begin + c) * rows, rows))
                                    : t00[c];
    }
    for (std::size_t row = 0; row < rows; ++row) {
      for (std::size_t c = 0; c < count; ++c) {
        const std::size_t i = begin + c;
        const auto m = [&](std::size_t a, std::size_t b) { return x.of_ones[a][i] * y.of_ones[b][row]; };
        out.height_m[row * columns + i] =
            plane_at_zero(m(0, 0), m(1, 0), m(0, 1), m(2, 0), m(1, 1), m(0, 2), t00[c][row], t10[c][row], t01[c][row]);
      }
    }
  }
  return out;
}

}  // namespace

ArealMap gaussian_mean_surface(const ArealMap& map, double cutoff_m) {
  if (!(cutoff_m > 0.0) || !std::isfinite(cutoff_m))
    throw Error("the cut-off " + number_text(cutoff_m) + " m is not a positive length");
  const std::size_t columns = map.columns, rows = map.rows;
  const double width_m = std::sqrt(std::numbers::ln2 / std::numbers::pi) * cutoff_m;
  const Moments along_x = moments_along(columns, map.x_spacing_m, width_m),
                along_y = moments_along(rows, map.y_spacing_m, width_m);
  if (std::none_of(map.height_m.begin(), map.height_m.end(), [](double z) { return std::isnan(z); }))
    return whole_mean_surface(map, along_x, along_y);
  // Rows first: moments of degree 0, 1, 2 of what is present, and 0, 1 of the heights, column by column.
  std::array<std::vector<double>, 5> moments;
  for (auto& one : moments) one.resize(columns * rows);
  std::vector<double> present(columns), height(columns);
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
