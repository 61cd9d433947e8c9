#include "asperity/simulation/load_surface.h"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "asperity/base/csv.h"
#include "asperity/base/error.h"
#include "asperity/base/text.h"

namespace asperity {
namespace {

constexpr std::uint64_t kLimitBytes = std::uint64_t{64} << 20;

struct Table {
  std::vector<std::string> header;  // empty without one
  std::size_t columns = 0;
  std::vector<std::array<double, 3>> rows;
  std::vector<std::size_t> lines;  // of the rows, from 1
};

Table read_table(const std::string& file) {
  const std::string text = read_file(file, kLimitBytes);
  Table table;
  std::string_view rest = text;
  std::size_t line = 0;
  while (!rest.empty()) {
    ++line;
    const std::size_t end = rest.find('\n');
    const std::string_view row = trim(rest.substr(0, end));
    rest = end == std::string_view::npos ? std::string_view{} : rest.substr(end + 1);
    if (row.empty() || row.front() == '#') continue;
    std::array<double, 3> values{};
    std::vector<std::string> cells;
    bool numeric = true;
    std::string_view left = row;
    while (true) {
      const std::size_t comma = left.find(',');
      const std::string_view cell = trim(left.substr(0, comma));
      const auto value = parse_double(cell);
      if (cells.size() == values.size()) throw Error(fmt::format("{}:{}: more than three columns", file, line));
      numeric = numeric && value.has_value();
      values[cells.size()] = value.value_or(0.0);
      cells.emplace_back(cell);
      if (comma == std::string_view::npos) break;
      left = left.substr(comma + 1);
    }
    if (table.columns == 0) table.columns = cells.size();
    if (cells.size() != table.columns) {
      throw Error(fmt::format("{}:{}: {} cells where the first line has {}", file, line, cells.size(), table.columns));
    }
    if (!numeric) {
      if (!table.rows.empty() || !table.header.empty()) {
        throw Error(fmt::format("{}:{}: not a number: '{}'", file, line, printable(row)));
      }
      table.header = cells;
      continue;
    }
    for (std::size_t c = 0; c < table.columns; ++c) {
      if (!std::isfinite(values[c])) throw Error(fmt::format("{}:{}: '{}' is not finite", file, line, cells[c]));
    }
    table.rows.push_back(values);
    table.lines.push_back(line);
  }
  return table;
}

// A relief of more than this is a wrong unit.
constexpr double kGreatestHeight_m = 0.1;

double height_of_row(const Table& table, const std::string& file, std::size_t row, std::size_t column, double scale) {
  const double height_m = table.rows[row][column] * scale;
  if (!(std::abs(height_m - table.rows[0][column] * scale) <= kGreatestHeight_m)) {
    throw Error(fmt::format("{}:{}: {} would be {} m above the first height; is the unit right?", file,
                            table.lines[row], table.rows[row][column], height_m - table.rows[0][column] * scale));
  }
  return height_m;
}

double unit_m(const Table& table, std::size_t column, double without) {
  if (table.header.empty()) return without;
  const std::string& name = table.header[column];
  const auto ends = [&](std::string_view end) {
    return name.size() >= end.size() && std::string_view(name).substr(name.size() - end.size()) == end;
  };
  if (ends("_um")) return 1e-6;
  if (ends("_mm")) return 1e-3;
  if (ends("_m")) return 1.0;
  return without;
}

// Index and fraction of `position` on a line of `count` samples continued by its mirror images.
struct Place {
  std::size_t index;
  double fraction;
};
Place mirrored(double position, std::size_t count) {
  if (count < 2) return {0, 0.0};
  const double last = static_cast<double>(count - 1);
  double folded = std::fmod(std::abs(position), 2.0 * last);
  if (folded > last) folded = 2.0 * last - folded;
  const auto index = std::min(static_cast<std::size_t>(folded), count - 2);
  return {index, folded - static_cast<double>(index)};
}

class Profile1d final : public Surface {
 public:
  Profile1d(std::vector<double> height_m, double spacing_m) : height_m_(std::move(height_m)), spacing_m_(spacing_m) {
    double mean = 0.0;
    for (const double h : height_m_) mean += h;
    mean /= static_cast<double>(height_m_.size());
    for (double& h : height_m_) h -= mean;
  }
  double height_m(double along_m, double) const override {
    const Place p = mirrored(along_m / spacing_m_ + 0.5 * static_cast<double>(height_m_.size() - 1), height_m_.size());
    return height_m_[p.index] + p.fraction * (height_m_[p.index + 1] - height_m_[p.index]);
  }

 private:
  std::vector<double> height_m_;
  double spacing_m_;
};

class ArealMap final : public Surface {
 public:
  ArealMap(std::vector<double> height_m, std::size_t nx, double dx_m, double dy_m)
      : height_m_(std::move(height_m)), nx_(nx), ny_(height_m_.size() / nx), dx_m_(dx_m), dy_m_(dy_m) {
    remove_plane();
  }
  double height_m(double along_m, double across_m) const override {
    const Place x = mirrored(along_m / dx_m_ + 0.5 * static_cast<double>(nx_ - 1), nx_);
    const Place y = mirrored(across_m / dy_m_ + 0.5 * static_cast<double>(ny_ - 1), ny_);
    const double* row = height_m_.data() + y.index * nx_ + x.index;
    const double near = row[0] + x.fraction * (row[1] - row[0]);
    const double far = row[nx_] + x.fraction * (row[nx_ + 1] - row[nx_]);
    return near + y.fraction * (far - near);
  }

 private:
  // On a full centred grid the columns 1, x, y are orthogonal, so each coefficient is one quotient.
  void remove_plane() {
    const double cx = 0.5 * static_cast<double>(nx_ - 1);
    const double cy = 0.5 * static_cast<double>(ny_ - 1);
    double sum = 0.0, sum_x = 0.0, sum_y = 0.0, xx = 0.0, yy = 0.0;
    for (std::size_t j = 0; j < ny_; ++j) {
      for (std::size_t i = 0; i < nx_; ++i) {
        const double h = height_m_[j * nx_ + i];
        const double x = static_cast<double>(i) - cx;
        const double y = static_cast<double>(j) - cy;
        sum += h;
        sum_x += h * x;
        sum_y += h * y;
        xx += x * x;
        yy += y * y;
      }
    }
    const double mean = sum / static_cast<double>(height_m_.size());
    for (std::size_t j = 0; j < ny_; ++j) {
      for (std::size_t i = 0; i < nx_; ++i) {
        height_m_[j * nx_ + i] -=
            mean + sum_x / xx * (static_cast<double>(i) - cx) + sum_y / yy * (static_cast<double>(j) - cy);
      }
    }
  }

  std::vector<double> height_m_;
  std::size_t nx_, ny_;
  double dx_m_, dy_m_;
};

std::unique_ptr<Surface> make_map(const Table& table, const SimulatedSurfaceConfig& config) {
  const std::string& file = config.file;
  const double ux = unit_m(table, 0, 1e-3);
  const double uy = unit_m(table, 1, 1e-3);
  const double uz = unit_m(table, 2, 1e-6) * config.file_scale;
  std::size_t nx = 1;
  while (nx < table.rows.size() && table.rows[nx][1] == table.rows[0][1]) ++nx;
  if (nx < 2 || table.rows.size() / nx < 2 || table.rows.size() % nx != 0) {
    throw Error(fmt::format("{}: {} rows do not make a full grid, its first row has {}", file, table.rows.size(), nx));
  }
  const double dx = table.rows[1][0] - table.rows[0][0];
  const double dy = table.rows[nx][1] - table.rows[0][1];
  if (!(dx > 0.0) || !(dy > 0.0)) throw Error(fmt::format("{}: x and y must rise", file));
  std::vector<double> height_m;
  height_m.reserve(table.rows.size());
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    const double x = table.rows[0][0] + dx * static_cast<double>(i % nx);
    const std::size_t row = i / nx;
    const double y = table.rows[0][1] + dy * static_cast<double>(row);
    // Coordinates are printed with few digits, so a tenth of the spacing is allowed.
    if (std::abs(table.rows[i][0] - x) > 0.1 * dx || std::abs(table.rows[i][1] - y) > 0.1 * dy) {
      throw Error(fmt::format("{}:{}: ({}, {}) where the grid has ({}, {})", file, table.lines[i], table.rows[i][0],
                              table.rows[i][1], x, y));
    }
    height_m.push_back(height_of_row(table, file, i, 2, uz));
  }
  return std::make_unique<ArealMap>(std::move(height_m), nx, dx * ux, dy * uy);
}

}  // namespace

std::unique_ptr<Surface> load_surface(const SimulatedSurfaceConfig& config) {
  if (config.file.empty()) throw Error("simulation.surface.file: empty, but surface.kind is \"file\"");
  const Table table = read_table(config.file);
  if (table.rows.size() < 2) throw Error(fmt::format("{}: fewer than two heights", config.file));
  if (table.columns == 3) return make_map(table, config);

  const std::size_t column = table.columns - 1;
  const double scale = unit_m(table, column, config.file_unit_m) * config.file_scale;
  double spacing_m = config.file_spacing_m;
  if (table.columns == 2) {
    const double first = table.rows.front()[0];
    const double step = (table.rows.back()[0] - first) / static_cast<double>(table.rows.size() - 1);
    if (!(step > 0.0)) throw Error(fmt::format("{}: positions must rise", config.file));
    for (std::size_t i = 0; i < table.rows.size(); ++i) {
      if (std::abs(table.rows[i][0] - first - step * static_cast<double>(i)) > 0.1 * step) {
        throw Error(fmt::format("{}:{}: position {} is not on the uniform grid of {}", config.file, table.lines[i],
                                table.rows[i][0], step));
      }
    }
    spacing_m = step * unit_m(table, 0, 1.0);
  }
  std::vector<double> height_m;
  height_m.reserve(table.rows.size());
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    height_m.push_back(height_of_row(table, config.file, i, column, scale));
  }
  return std::make_unique<Profile1d>(std::move(height_m), spacing_m);
}

}  // namespace asperity
