#include "asperity/base/read_areal_map.h"

#include <cmath>
#include <string>
#include <utility>

#include "asperity/base/text.h"

namespace asperity {
namespace {

// Positions come rounded to a few digits; half a step would be a point of the next row.
constexpr double kPositionTolerance_steps = 0.1;

struct Point {
  double x_m = 0.0;
  double y_m = 0.0;
  double z_m = 0.0;
};

ArealMap transposed(const ArealMap& map) {
  ArealMap result{map.y_spacing_m, map.x_spacing_m, map.rows, map.columns, {}};
  result.height_m.reserve(map.height_m.size());
  for (std::size_t column = 0; column < map.columns; ++column) {
    for (std::size_t row = 0; row < map.rows; ++row) result.height_m.push_back(map.at(row, column));
  }
  return result;
}

}  // namespace

ArealMap read_areal_map(CsvReader& table, const std::array<double, 3>& unit_m) {
  bool y_runs_fastest = false;
  const auto read = [&](Point& p) {
    if (!table.next()) return false;
    p = {table.finite_or_nan(0) * unit_m[0], table.finite_or_nan(1) * unit_m[1], table.finite_or_nan(2) * unit_m[2]};
    if (std::isnan(p.x_m) || std::isnan(p.y_m)) table.fail("the position is not a number");
    if (y_runs_fastest) std::swap(p.x_m, p.y_m);
    return true;
  };

  ArealMap map;
  Point first, point;
  if (!read(first) || !read(point)) table.fail("an areal map has at least 2 by 2 points");
  if (point.x_m == first.x_m && point.y_m != first.y_m) {
    y_runs_fastest = true;
    std::swap(first.x_m, first.y_m);
    std::swap(point.x_m, point.y_m);
  }
  if (!(point.x_m > first.x_m) || point.y_m != first.y_m) table.fail("the second point is not the next along x or y");
  map.height_m = {first.z_m, point.z_m};
  map.x_spacing_m = point.x_m - first.x_m;

  // The spacings are refined as points come: a single step is known only to the file's digits.
  std::size_t column = 2;
  std::size_t row = 0;
  while (read(point)) {
    if (map.columns == 0 && std::abs(point.x_m - first.x_m) < 0.5 * map.x_spacing_m) map.columns = column;
    if (map.columns != 0 && column == map.columns) {
      column = 0;
      ++row;
      if (row == 1) {
        map.y_spacing_m = point.y_m - first.y_m;
        if (!(map.y_spacing_m > 0.0)) table.fail("the second row does not follow the first");
      }
    }
    const double dx = point.x_m - first.x_m - static_cast<double>(column) * map.x_spacing_m;
    const double dy = point.y_m - first.y_m - static_cast<double>(row) * map.y_spacing_m;
    if (!(std::abs(dx) <= kPositionTolerance_steps * map.x_spacing_m) ||
        (row > 0 ? !(std::abs(dy) <= kPositionTolerance_steps * map.y_spacing_m) : dy != 0.0)) {
      table.fail("the point (" + number_text(point.x_m) + ", " + number_text(point.y_m) + ") m is not the grid's next");
    }
    if (map.columns == 0) map.x_spacing_m = (point.x_m - first.x_m) / static_cast<double>(column);
    if (row > 0 && column == 0) map.y_spacing_m = (point.y_m - first.y_m) / static_cast<double>(row);
    map.height_m.push_back(point.z_m);
    ++column;
  }
  if (map.columns == 0 || row == 0) table.fail("an areal map has at least 2 by 2 points");
  if (column != map.columns) {
    table.fail("the last row has " + std::to_string(column) + " points where the first has " +
               std::to_string(map.columns));
  }
  map.rows = row + 1;
  return y_runs_fastest ? transposed(map) : map;
}

}  // namespace asperity
