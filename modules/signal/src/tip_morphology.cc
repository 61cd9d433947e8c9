#include "asperity/signal/tip_morphology.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "asperity/base/error.h"
#include "asperity/base/nan.h"
#include "asperity/base/text.h"

namespace asperity {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kMostPairs = 1e10;

struct BallOffset {
  std::ptrdiff_t row = 0, column = 0;
  double height_m = 0.0;  // of the ball's underside over its lowest point, −b(u)
};

// The offsets at which the ball can matter: where its underside is no higher than the heights' range.
struct BallOffsets {
  std::ptrdiff_t row_reach = 0, column_reach = 0;
  std::vector<BallOffset> offsets;
};

// What a person may have passed, checked once.
void check_grid(std::span<const double> height_m, const HeightGridShape& shape, double tip_radius_m,
                double resolution_m) {
  if (shape.rows == 0 || height_m.size() % shape.rows != 0 || height_m.size() / shape.rows != shape.columns) {
    throw Error("tip: " + std::to_string(height_m.size()) + " heights do not fill " + std::to_string(shape.rows) +
                " rows of " + std::to_string(shape.columns));
  }
  const auto is_spacing = [](double spacing_m) { return std::isfinite(spacing_m) && spacing_m > 0.0; };
  const bool spaced = is_spacing(shape.column_spacing_m) && (shape.rows == 1 || is_spacing(shape.row_spacing_m));
  if (!spaced) throw Error("tip: the spacing of the heights must be finite and positive");
  if (!std::isfinite(tip_radius_m) || tip_radius_m < 0.0) {
    throw Error("tip: the radius must be finite and at least 0, is " + number_text(tip_radius_m) + " m");
  }
  if (!std::isfinite(resolution_m) || resolution_m < 0.0) {
    throw Error("tip: the resolution must be finite and at least 0, is " + number_text(resolution_m) + " m");
  }
}

BallOffsets make_ball(std::span<const double> height_m, const HeightGridShape& shape, double radius_m) {
  double low_m = kInfinity, high_m = -kInfinity;
  for (const double h : height_m) {
    if (!std::isfinite(h)) continue;
    low_m = std::min(low_m, h);
    high_m = std::max(high_m, h);
  }
  const double range_m = high_m > low_m ? high_m - low_m : 0.0;
  // √(R² − (R − range)²): a higher part of the ball cannot touch.
  const double reach_m =
      range_m >= radius_m ? radius_m : std::sqrt(std::max(0.0, range_m * (2.0 * radius_m - range_m)));
  const auto steps = [&](double spacing_m, std::size_t count) {
    return static_cast<std::ptrdiff_t>(std::min(std::ceil(reach_m / spacing_m), static_cast<double>(count)));
  };
  BallOffsets ball;
  ball.row_reach = shape.rows == 1 ? 0 : steps(shape.row_spacing_m, shape.rows);
  ball.column_reach = steps(shape.column_spacing_m, shape.columns);
  const double pairs = (2.0 * static_cast<double>(ball.row_reach) + 1.0) *
                       (2.0 * static_cast<double>(ball.column_reach) + 1.0) * static_cast<double>(height_m.size());
  if (pairs > kMostPairs) {
    throw Error("tip: a radius of " + number_text(radius_m) + " m over " + std::to_string(height_m.size()) +
                " points is too much to compute");
  }
  for (std::ptrdiff_t row = -ball.row_reach; row <= ball.row_reach; ++row) {
    for (std::ptrdiff_t column = -ball.column_reach; column <= ball.column_reach; ++column) {
      const double y_m = row == 0 ? 0.0 : static_cast<double>(row) * shape.row_spacing_m;
      const double x_m = static_cast<double>(column) * shape.column_spacing_m;
      const double left_m2 = radius_m * radius_m - x_m * x_m - y_m * y_m;
      if (left_m2 < 0.0) continue;
      ball.offsets.push_back({row, column, radius_m - std::sqrt(left_m2)});
    }
  }
  return ball;
}

// Values at the points and on a border around them, as wide as the ball reaches.
class Bordered {
 public:
  Bordered(const HeightGridShape& shape, const BallOffsets& ball, double value)
      : row_reach_(ball.row_reach),
        column_reach_(ball.column_reach),
        width_(static_cast<std::ptrdiff_t>(shape.columns) + 2 * ball.column_reach),
        cells_(static_cast<std::size_t>(width_ * (static_cast<std::ptrdiff_t>(shape.rows) + 2 * ball.row_reach)),
               value) {}

  std::size_t index(std::ptrdiff_t row, std::ptrdiff_t column) const {
    return static_cast<std::size_t>((row + row_reach_) * width_ + column + column_reach_);
  }
  double& at(std::ptrdiff_t row, std::ptrdiff_t column) { return cells_[index(row, column)]; }
  double at(std::ptrdiff_t row, std::ptrdiff_t column) const { return cells_[index(row, column)]; }
  double& operator[](std::size_t i) { return cells_[i]; }
  double operator[](std::size_t i) const { return cells_[i]; }
  std::ptrdiff_t step_to(const BallOffset& offset) const { return offset.row * width_ + offset.column; }

 private:
  std::ptrdiff_t row_reach_, column_reach_, width_;
  std::vector<double> cells_;
};

template <class Visit>
void for_each_point(const HeightGridShape& shape, Visit visit) {
  for (std::size_t row = 0; row < shape.rows; ++row) {
    for (std::size_t column = 0; column < shape.columns; ++column) {
      visit(static_cast<std::ptrdiff_t>(row), static_cast<std::ptrdiff_t>(column), row * shape.columns + column);
    }
  }
}

// The ceiling that every known position of the ball sets to the points under it, the border's too; infinite where no
// ball has been.
Bordered lowest_undersides(std::span<const double> height_m, const HeightGridShape& shape, const BallOffsets& ball) {
  Bordered ceiling(shape, ball, kInfinity);
  for_each_point(shape, [&](std::ptrdiff_t row, std::ptrdiff_t column, std::size_t i) {
    if (!std::isfinite(height_m[i])) return;
    const auto here = static_cast<std::ptrdiff_t>(ceiling.index(row, column));
    for (const BallOffset& offset : ball.offsets) {
      double& cell = ceiling[static_cast<std::size_t>(here + ceiling.step_to(offset))];
      cell = std::min(cell, height_m[i] + offset.height_m);
    }
  });
  return ceiling;
}

// The extent of a set of offsets.
struct Extent {
  std::ptrdiff_t first_row = 0, last_row = 0, first_column = 0, last_column = 0;

  explicit Extent(std::span<const BallOffset> set) {
    if (set.empty()) return;
    first_row = last_row = set.front().row;
    first_column = last_column = set.front().column;
    for (const BallOffset& one : set) {
      first_row = std::min(first_row, one.row);
      last_row = std::max(last_row, one.row);
      first_column = std::min(first_column, one.column);
      last_column = std::max(last_column, one.column);
    }
  }
};

}  // namespace

TipErosion erode_by_tip(std::span<const double> height_m, const HeightGridShape& shape, double tip_radius_m,
                        double resolution_m) {
  check_grid(height_m, shape, tip_radius_m, resolution_m);
  TipErosion out{std::vector<double>(height_m.size(), kNan), std::vector<char>(height_m.size(), 0)};
  const BallOffsets ball = make_ball(height_m, shape, tip_radius_m);
  const Bordered ceiling = lowest_undersides(height_m, shape, ball);
  const double tie_m = 1e-12 * tip_radius_m;  // rounding must not part a contact
  const double as_one_m = resolution_m * (1.0 + 1e-9);
  const auto is_known = [&](std::ptrdiff_t row, std::ptrdiff_t column) {
    return row >= 0 && row < static_cast<std::ptrdiff_t>(shape.rows) && column >= 0 &&
           column < static_cast<std::ptrdiff_t>(shape.columns) &&
           std::isfinite(height_m[static_cast<std::size_t>(row) * shape.columns + static_cast<std::size_t>(column)]);
  };

  std::vector<BallOffset> contacts;
  for_each_point(shape, [&](std::ptrdiff_t row, std::ptrdiff_t column, std::size_t i) {
    if (!std::isfinite(height_m[i])) return;
    out.surface_m[i] = ceiling.at(row, column);
    contacts.clear();
    for (const BallOffset& offset : ball.offsets) {
      const std::ptrdiff_t r = row + offset.row, c = column + offset.column;
      if (height_m[i] + offset.height_m - ceiling.at(r, c) > tie_m) continue;
      // The point that is not known may be the one.
      if (!is_known(r, c)) return;
      contacts.push_back(offset);
    }
    const Extent extent(contacts);
    const auto length_m = [](std::ptrdiff_t first, std::ptrdiff_t last, double spacing_m) {
      return static_cast<double>(last - first) * spacing_m;
    };
    if (length_m(extent.first_row, extent.last_row, shape.row_spacing_m) > as_one_m) return;
    if (length_m(extent.first_column, extent.last_column, shape.column_spacing_m) > as_one_m) return;
    for (const BallOffset& offset : contacts) {
      out.touched[static_cast<std::size_t>(row + offset.row) * shape.columns +
                  static_cast<std::size_t>(column + offset.column)] = 1;
    }
  });
  return out;
}

std::vector<double> open_by_tip(std::span<const double> height_m, const HeightGridShape& shape, double tip_radius_m) {
  check_grid(height_m, shape, tip_radius_m, 0.0);
  const BallOffsets ball = make_ball(height_m, shape, tip_radius_m);
  // The ceiling beyond the ends belongs to it: without it the ball would fall there.
  const Bordered ceiling = lowest_undersides(height_m, shape, ball);
  std::vector<double> out(height_m.size(), kNan);
  for_each_point(shape, [&](std::ptrdiff_t row, std::ptrdiff_t column, std::size_t i) {
    if (!std::isfinite(height_m[i])) return;
    const auto here = static_cast<std::ptrdiff_t>(ceiling.index(row, column));
    double top_m = -kInfinity;
    for (const BallOffset& offset : ball.offsets) {
      const double at_m = ceiling[static_cast<std::size_t>(here + ceiling.step_to(offset))];
      if (at_m < kInfinity) top_m = std::max(top_m, at_m - offset.height_m);
    }
    out[i] = std::min(top_m, height_m[i]);
  });
  return out;
}

TipErosion erode_profile_by_tip(std::span<const double> height_m, double spacing_m, double tip_radius_m,
                                double resolution_m) {
  return erode_by_tip(height_m, {1, height_m.size(), spacing_m, spacing_m}, tip_radius_m, resolution_m);
}

}  // namespace asperity
