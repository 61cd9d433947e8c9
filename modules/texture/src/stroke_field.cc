#include "stroke_field.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <Eigen/SparseCore>

#include "asperity/algebra/sparse_cholesky.h"
#include "asperity/base/error.h"
#include "spline_weights.h"

namespace asperity {
namespace {

using Matrix = Eigen::SparseMatrix<double>;
using Entries = std::vector<Eigen::Triplet<double>>;

// The sixteen splines over a place.
struct SplinePatch {
  std::array<Eigen::Index, 16> index{};
  std::array<double, 16> weight{}, slope_x{}, slope_y{};  // slopes a mm
};

SplinePatch spline_patch(const MapGrid& grid, double x_mm, double y_mm) {
  const double u = (x_mm - grid.x_mm) / grid.spacing_mm, v = (y_mm - grid.y_mm) / grid.spacing_mm;
  const int column = std::clamp(static_cast<int>(std::floor(u)), 1, grid.columns - 3);
  const int row = std::clamp(static_cast<int>(std::floor(v)), 1, grid.rows - 3);
  std::array<double, 4> wx{}, sx{}, wy{}, sy{};
  spline_weights(u - column, wx, sx);
  spline_weights(v - row, wy, sy);
  SplinePatch out;
  for (std::size_t r = 0; r < 4; ++r) {
    for (std::size_t c = 0; c < 4; ++c) {
      const std::size_t i = 4 * r + c;
      out.index[i] =
          static_cast<Eigen::Index>(row - 1 + static_cast<int>(r)) * grid.columns + column - 1 + static_cast<int>(c);
      out.weight[i] = wx[c] * wy[r];
      out.slope_x[i] = sx[c] * wy[r] / grid.spacing_mm;
      out.slope_y[i] = wx[c] * sy[r] / grid.spacing_mm;
    }
  }
  return out;
}

// The precision of the splines' coefficients: (spacing²/A)(κ⁴ + 2 t κ² L + L²), L the grid's negative Laplacian.
void add_surface_prior(const MapGrid& grid, const ArealSpectrum& s, Entries& entries) {
  const double inverse = 1.0 / (grid.spacing_mm * grid.spacing_mm);
  const auto at = [&](int c, int r) { return static_cast<Eigen::Index>(r) * grid.columns + c; };
  Entries of_laplacian;
  for (int r = 0; r < grid.rows; ++r) {
    for (int c = 0; c < grid.columns; ++c) {
      for (const auto& [dc, dr] : {std::pair{1, 0}, std::pair{0, 1}}) {
        if (c + dc >= grid.columns || r + dr >= grid.rows) continue;
        const auto a = at(c, r), b = at(c + dc, r + dr);
        of_laplacian.emplace_back(a, a, inverse);
        of_laplacian.emplace_back(b, b, inverse);
        of_laplacian.emplace_back(a, b, -inverse);
        of_laplacian.emplace_back(b, a, -inverse);
      }
    }
  }
  Matrix L(grid.size(), grid.size());
  L.setFromTriplets(of_laplacian.begin(), of_laplacian.end());
  const double k2 = s.kappa_per_mm * s.kappa_per_mm;
  Matrix identity(grid.size(), grid.size());
  identity.setIdentity();
  const Matrix Q =
      (grid.spacing_mm * grid.spacing_mm / s.A) * (k2 * k2 * identity + 2.0 * s.t * k2 * L + Matrix(L * L));
  for (int j = 0; j < Q.outerSize(); ++j)
    for (Matrix::InnerIterator it(Q, j); it; ++it)
      if (it.row() >= it.col()) entries.emplace_back(it.row(), it.col(), it.value());
  // The heights at grid points take nine splines: their covariances are wanted, with samples near or not.
  for (int r = 0; r < grid.rows; ++r)
    for (int c = 0; c < grid.columns; ++c)
      for (int dr = 0; dr <= 2; ++dr)
        for (int dc = -2; dc <= 2; ++dc)
          if (r + dr < grid.rows && c + dc >= 0 && c + dc < grid.columns && (dr > 0 || dc > 0))
            entries.emplace_back(at(c + dc, r + dr), at(c, r), 0.0);
}

struct Unknowns {
  Eigen::Index splines = 0, hats = 0, strokes = 0;
  bool shifts = false;
  Eigen::Index hat(Eigen::Index i) const { return splines + i; }
  Eigen::Index offset(Eigen::Index k) const { return splines + hats + k; }
  Eigen::Index shift(Eigen::Index k, int axis) const { return splines + hats + strokes + 2 * k + axis; }
  Eigen::Index size() const { return splines + hats + strokes + (shifts ? 2 * strokes : 0); }
};

void fill_sigma(const Matrix& covariance, StrokeField& out) {
  const MapGrid& grid = out.grid;
  constexpr std::array<double, 3> kWeight{1.0 / 6.0, 4.0 / 6.0, 1.0 / 6.0};
  out.sigma_m.assign(static_cast<std::size_t>(grid.size()), 0.0);
  for (int r = 0; r < grid.rows; ++r) {
    for (int c = 0; c < grid.columns; ++c) {
      // At the outermost points not all splines are there: those of their neighbours.
      const int row = std::clamp(r, 1, grid.rows - 2), column = std::clamp(c, 1, grid.columns - 2);
      std::array<Eigen::Index, 9> index{};
      std::array<double, 9> weight{};
      for (int i = 0; i < 9; ++i) {
        const auto place = static_cast<std::size_t>(i);
        index[place] = static_cast<Eigen::Index>(row + i / 3 - 1) * grid.columns + column + i % 3 - 1;
        weight[place] = kWeight[place / 3] * kWeight[place % 3];
      }
      double variance = 0.0;
      for (std::size_t a = 0; a < 9; ++a) {
        variance += weight[a] * weight[a] * covariance.coeff(index[a], index[a]);
        for (std::size_t b = 0; b < a; ++b)
          variance += 2.0 * weight[a] * weight[b] * covariance.coeff(index[a], index[b]);
      }
      out.sigma_m[static_cast<std::size_t>(static_cast<Eigen::Index>(r) * grid.columns + c)] =
          std::sqrt(std::max(variance, 0.0));
    }
  }
}

}  // namespace

Eigen::Vector3d StrokeField::at(double x_mm, double y_mm) const {
  const SplinePatch patch = spline_patch(grid, x_mm, y_mm);
  Eigen::Vector3d out = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < 16; ++i) {
    const double c = coefficient_m[patch.index[i]];
    out += c * Eigen::Vector3d(patch.weight[i], patch.slope_x[i], patch.slope_y[i]);
  }
  return out;
}

double StrokeField::sigma_at(double x_mm, double y_mm) const {
  const auto column =
      std::clamp(static_cast<int>(std::lround((x_mm - grid.x_mm) / grid.spacing_mm)), 0, grid.columns - 1);
  const auto row = std::clamp(static_cast<int>(std::lround((y_mm - grid.y_mm) / grid.spacing_mm)), 0, grid.rows - 1);
  return sigma_m[static_cast<std::size_t>(static_cast<Eigen::Index>(row) * grid.columns + column)];
}

MapGrid make_map_grid(const std::vector<StrokeSample>& samples, double spacing_mm, double margin_mm) {
  double low_x = samples.front().x_mm, high_x = low_x, low_y = samples.front().y_mm, high_y = low_y;
  for (const StrokeSample& s : samples) {
    low_x = std::min(low_x, s.x_mm);
    high_x = std::max(high_x, s.x_mm);
    low_y = std::min(low_y, s.y_mm);
    high_y = std::max(high_y, s.y_mm);
  }
  MapGrid out;
  out.spacing_mm = spacing_mm;
  const double edge_mm = margin_mm + 2.0 * spacing_mm;
  out.x_mm = low_x - edge_mm;
  out.y_mm = low_y - edge_mm;
  constexpr double kMostASide = 1e9;  // far more than can be solved, and an int
  const auto points = [&](double length_mm) {
    return static_cast<int>(std::min(std::ceil((length_mm + 2.0 * edge_mm) / spacing_mm), kMostASide)) + 1;
  };
  out.columns = points(high_x - low_x);
  out.rows = points(high_y - low_y);
  return out;
}

StrokeField solve_field(const MapGrid& grid, const std::vector<StrokeSample>& samples, const DriftBasis& basis,
                        const FieldPrior& prior, const std::vector<Eigen::Vector2d>& start_shift_mm, int steps,
                        bool with_sigma) {
  StrokeField out;
  out.grid = grid;
  out.shift_mm = start_shift_mm;
  Unknowns unknowns;
  unknowns.splines = grid.size();
  unknowns.hats = static_cast<Eigen::Index>(basis.size());
  unknowns.strokes = static_cast<Eigen::Index>(basis.first.size()) - 1;
  Entries of_prior;
  add_surface_prior(grid, prior.spectrum, of_prior);
  for (Eigen::Index i = 0; i < unknowns.hats; ++i)
    of_prior.emplace_back(unknowns.hat(i), unknowns.hat(i), 1.0 / (prior.drift_m * prior.drift_m));
  for (Eigen::Index k = 0; k < unknowns.strokes; ++k)
    of_prior.emplace_back(unknowns.offset(k), unknowns.offset(k), 1.0 / (prior.offset_m * prior.offset_m));
  const double reach_mm = 4.0 * prior.shift_mm;

  for (int step = 0; step < std::max(steps, 1); ++step) {
    // Without a surface there is no slope along which a shift would show.
    unknowns.shifts = prior.shift_mm > 0.0 && step > 0;
    Entries entries = of_prior;
    if (unknowns.shifts) {
      for (Eigen::Index k = 0; k < unknowns.strokes; ++k)
        for (const int axis : {0, 1})
          entries.emplace_back(unknowns.shift(k, axis), unknowns.shift(k, axis),
                               1.0 / (prior.shift_mm * prior.shift_mm));
    }
    Eigen::VectorXd right = Eigen::VectorXd::Zero(unknowns.size());
    std::array<std::pair<Eigen::Index, double>, 21> row{};
    for (const StrokeSample& s : samples) {
      const Eigen::Vector2d shift = out.shift_mm[s.stroke];
      const SplinePatch patch = spline_patch(grid, s.x_mm + shift.x(), s.y_mm + shift.y());
      std::size_t count = 0;
      for (; count < 16; ++count) row[count] = {patch.index[count], patch.weight[count]};
      const Eigen::Index hats = basis.first[s.stroke + 1] - basis.first[s.stroke];
      const Eigen::Index i = std::min(static_cast<Eigen::Index>(s.s_mm / basis.knot_mm), hats - 2);
      const double share = s.s_mm / basis.knot_mm - static_cast<double>(i);
      const Eigen::Index first = unknowns.hat(basis.first[s.stroke] + i);
      row[count++] = {first, 1.0 - share};
      row[count++] = {first + 1, share};
      row[count++] = {unknowns.offset(s.stroke), 1.0};
      double value = s.height_m;
      if (unknowns.shifts) {
        double gx = 0.0, gy = 0.0;
        for (std::size_t n = 0; n < 16; ++n) {
          gx += patch.slope_x[n] * out.coefficient_m[patch.index[n]];
          gy += patch.slope_y[n] * out.coefficient_m[patch.index[n]];
        }
        row[count++] = {unknowns.shift(s.stroke, 0), gx};
        row[count++] = {unknowns.shift(s.stroke, 1), gy};
        value += gx * shift.x() + gy * shift.y();
      }
      for (std::size_t a = 0; a < count; ++a) {
        right[row[a].first] += row[a].second * value / prior.noise_m2;
        for (std::size_t b = 0; b < count; ++b)
          if (row[a].first >= row[b].first)
            entries.emplace_back(row[a].first, row[b].first, row[a].second * row[b].second / prior.noise_m2);
      }
    }
    Matrix H(unknowns.size(), unknowns.size());
    H.setFromTriplets(entries.begin(), entries.end());
    const SparseCholesky cholesky(H);
    if (!cholesky.positive_definite()) throw Error("area: the map's equations cannot be solved");
    const Eigen::VectorXd x = cholesky.solve(right);
    out.coefficient_m = x.head(unknowns.splines);
    out.hat_m = x.segment(unknowns.splines, unknowns.hats);
    for (Eigen::Index k = 0; k < unknowns.strokes; ++k) {
      for (Eigen::Index i = basis.first[static_cast<std::size_t>(k)]; i < basis.first[static_cast<std::size_t>(k) + 1];
           ++i)
        out.hat_m[i] += x[unknowns.offset(k)];
      if (!unknowns.shifts) continue;
      // Within the reach for which the grid has a margin.
      Eigen::Vector2d shift(x[unknowns.shift(k, 0)], x[unknowns.shift(k, 1)]);
      out.shift_mm[static_cast<std::size_t>(k)] = shift.cwiseMax(-reach_mm).cwiseMin(reach_mm);
    }
    if (with_sigma && step + 1 == std::max(steps, 1)) fill_sigma(cholesky.selected_inverse(), out);
  }
  return out;
}

}  // namespace asperity
