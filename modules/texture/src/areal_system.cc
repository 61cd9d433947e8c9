#include "areal_system.h"

#include <algorithm>
#include <cmath>

#include "asperity/texture/evaluate_spline_grid.h"
#include "border.h"

namespace asperity {
namespace {

double dot(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

// Calls visit(i, {index, weight}…) for each second difference over the grid: along x, along y, and mixed
// (weighted by √2, so that its square counts twice).
template <class Visit3, class Visit4>
void for_each_difference(std::size_t columns, std::size_t rows, bool periodic, const Visit3& straight,
                         const Visit4& mixed) {
  const auto next = [periodic](std::size_t i, std::size_t step, std::size_t count) {
    return periodic ? (i + step) % count : i + step;
  };
  const std::size_t end_x = periodic ? columns : columns - 2;
  const std::size_t end_y = periodic ? rows : rows - 2;
  for (std::size_t r = 0; r < rows; ++r) {
    const std::size_t row = r * columns;
    for (std::size_t c = 0; c < end_x; ++c) straight(row + c, row + next(c, 1, columns), row + next(c, 2, columns));
  }
  for (std::size_t r = 0; r < end_y; ++r) {
    const std::size_t below = next(r, 1, rows) * columns;
    const std::size_t below2 = next(r, 2, rows) * columns;
    for (std::size_t c = 0; c < columns; ++c) straight(r * columns + c, below + c, below2 + c);
  }
  for (std::size_t r = 0; r < (periodic ? rows : rows - 1); ++r) {
    const std::size_t below = next(r, 1, rows) * columns;
    for (std::size_t c = 0; c < (periodic ? columns : columns - 1); ++c) {
      const std::size_t right = next(c, 1, columns);
      mixed(r * columns + c, r * columns + right, below + c, below + right);
    }
  }
}

}  // namespace

void resample_grid(const SplineGrid& from, SplineGrid& to) {
  for (std::size_t r = 0; r < to.rows; ++r) {
    for (std::size_t c = 0; c < to.columns; ++c) {
      to.coefficient_m[r * to.columns + c] =
          evaluate_height(from, to.origin_x_m + to.spacing_x_m * static_cast<double>(c),
                          to.origin_y_m + to.spacing_y_m * static_cast<double>(r))
              .height_m;
    }
  }
}

ArealSystem::ArealSystem(const SplineGrid& grid, std::span<const ArealSample> samples, double mean_m, double smoothness)
    : columns_(grid.columns), rows_(grid.rows), periodic_(grid.border == Border::kPeriodic) {
  const std::size_t count = columns_ * rows_;
  lambda_ = smoothness * std::max(1.0, static_cast<double>(samples.size()) / static_cast<double>(count));
  right_.assign(count, 0.0);
  weight_.assign(count, 0.0);
  samples_.reserve(samples.size());
  const auto side = [&](double u, std::size_t size, std::array<std::uint32_t, 4>& index,
                        std::array<double, 4>& weight) {
    if (periodic_) u -= static_cast<double>(size) * std::floor(u / static_cast<double>(size));
    double cell = std::floor(u);
    if (!periodic_) cell = std::clamp(cell, 1.0, static_cast<double>(size) - 3.0);
    const double t = u - cell;
    const double s = 1.0 - t;
    weight = {s * s * s / 6.0, (4.0 - 3.0 * t * t * (1.0 + s)) / 6.0, (4.0 - 3.0 * s * s * (1.0 + t)) / 6.0,
              t * t * t / 6.0};
    const Neighbours n = neighbours(static_cast<std::ptrdiff_t>(cell) - 1, size, grid.border);
    for (std::size_t k = 0; k < 4; ++k) index[k] = static_cast<std::uint32_t>(n.index[k]);
  };
  for (const auto& s : samples) {
    Row row{};
    side((s.x_m - grid.origin_x_m) / grid.spacing_x_m, columns_, row.column, row.x);
    side((s.y_m - grid.origin_y_m) / grid.spacing_y_m, rows_, row.row, row.y);
    for (std::size_t j = 0; j < 4; ++j) {
      for (std::size_t k = 0; k < 4; ++k) {
        const std::size_t at = row.row[j] * columns_ + row.column[k];
        const double b = row.y[j] * row.x[k];
        right_[at] += b * (s.height_m - mean_m);
        weight_[at] += b * b;
      }
    }
    samples_.push_back(row);
  }
  diagonal_ = weight_;
  for_each_difference(
      columns_, rows_, periodic_,
      [&](std::size_t a, std::size_t b, std::size_t c) {
        diagonal_[a] += lambda_, diagonal_[b] += 4.0 * lambda_, diagonal_[c] += lambda_;
      },
      [&](std::size_t a, std::size_t b, std::size_t c, std::size_t d) {
        for (const std::size_t i : {a, b, c, d}) diagonal_[i] += 2.0 * lambda_;
      });
}

void ArealSystem::apply(const std::vector<double>& c, std::vector<double>& out) const {
  std::fill(out.begin(), out.end(), 0.0);
  for (const Row& s : samples_) {
    double height = 0.0;
    for (std::size_t j = 0; j < 4; ++j) {
      const double* row = c.data() + s.row[j] * columns_;
      double sum = 0.0;
      for (std::size_t k = 0; k < 4; ++k) sum += s.x[k] * row[s.column[k]];
      height += s.y[j] * sum;
    }
    for (std::size_t j = 0; j < 4; ++j) {
      double* row = out.data() + s.row[j] * columns_;
      const double scaled = s.y[j] * height;
      for (std::size_t k = 0; k < 4; ++k) row[s.column[k]] += s.x[k] * scaled;
    }
  }
  for_each_difference(
      columns_, rows_, periodic_,
      [&](std::size_t i, std::size_t j, std::size_t k) {
        const double d = lambda_ * (c[i] - 2.0 * c[j] + c[k]);
        out[i] += d, out[j] -= 2.0 * d, out[k] += d;
      },
      [&](std::size_t i, std::size_t j, std::size_t k, std::size_t l) {
        const double d = 2.0 * lambda_ * (c[i] - c[j] - c[k] + c[l]);
        out[i] += d, out[j] -= d, out[k] -= d, out[l] += d;
      });
}

double ArealSystem::solve(std::vector<double>& c, int iterations, double tolerance, const Observer& observer) const {
  const std::size_t count = c.size();
  std::vector<double> residual(count), direction(count), image(count), preconditioned(count);
  apply(c, image);
  for (std::size_t i = 0; i < count; ++i) residual[i] = right_[i] - image[i];
  const double scale = std::sqrt(dot(right_, right_));
  if (scale == 0.0) {
    std::fill(c.begin(), c.end(), 0.0);
    return 0.0;
  }
  const auto precondition = [&] {
    for (std::size_t i = 0; i < count; ++i) preconditioned[i] = residual[i] / diagonal_[i];
  };
  precondition();
  direction = preconditioned;
  double product = dot(residual, preconditioned);
  double relative = std::sqrt(dot(residual, residual)) / scale;
  for (int step = 0; step < iterations && relative > tolerance; ++step) {
    observer.update("texture", static_cast<double>(step) / iterations);
    apply(direction, image);
    const double along = dot(direction, image);
    if (!(along > 0.0)) break;
    const double alpha = product / along;
    for (std::size_t i = 0; i < count; ++i) c[i] += alpha * direction[i], residual[i] -= alpha * image[i];
    precondition();
    const double next = dot(residual, preconditioned);
    const double beta = next / product;
    product = next;
    for (std::size_t i = 0; i < count; ++i) direction[i] = preconditioned[i] + beta * direction[i];
    relative = std::sqrt(dot(residual, residual)) / scale;
  }
  return relative;
}

std::vector<std::uint8_t> ArealSystem::supported() const {
  // A spline's square is (2/3)⁴ at its centre and (23/48)²·(2/3)² half a cell off along one axis; below a
  // hundredth of the centre's, its samples lie more than about one cell and a half away.
  constexpr double kLeast = 0.01 * 16.0 / 81.0;
  std::vector<std::uint8_t> flags(weight_.size());
  for (std::size_t i = 0; i < flags.size(); ++i) flags[i] = weight_[i] >= kLeast ? 1 : 0;
  return flags;
}

}  // namespace asperity
