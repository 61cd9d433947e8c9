#include "load_surface.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "asperity/base/column_unit.h"
#include "asperity/base/csv.h"
#include "asperity/base/decode_text.h"
#include "asperity/base/error.h"
#include "asperity/base/read_areal_map.h"
#include "asperity/base/text.h"
#include "asperity/image/tiff_image.h"
#include "asperity/profile/read_heights.h"
#include "asperity/surface/parse_surface_file.h"

namespace asperity {
namespace {

constexpr std::uint64_t kLimitBytes = std::uint64_t{64} << 20;
constexpr double kSpacingOfHeights_m = 0.5e-6;  // of a column of heights where none is given

// A relief of more than this is a wrong unit.
constexpr double kGreatestHeight_m = 0.1;

bool is_plausible(double height_m, double first_m) { return std::abs(height_m - first_m) <= kGreatestHeight_m; }

Error implausible(const std::string& where, double height_m, double first_m) {
  return Error(fmt::format("{}: {} m above the first height; is the unit right?", where, height_m - first_m));
}

// The unit in a column's name, or `without` if there is none.
double unit_m(const CsvReader& table, std::size_t column, double without) {
  if (table.columns().empty()) return without;
  const ColumnUnit stated = column_unit(table.columns()[column]);
  if (stated.is_other())
    table.fail("column '" + printable(table.columns()[column]) + "': its unit '" + printable(stated.unit) +
               "' is not a length that is known");
  return stated.unit_m.value_or(without);
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

class ProfileRelief final : public Surface {
 public:
  ProfileRelief(std::vector<double> height_m, double spacing_m)
      : height_m_(std::move(height_m)), spacing_m_(spacing_m) {
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

class ArealRelief final : public Surface {
 public:
  explicit ArealRelief(ArealMap map)
      : height_m_(std::move(map.height_m)),
        nx_(map.columns),
        ny_(map.rows),
        dx_m_(map.x_spacing_m),
        dy_m_(map.y_spacing_m) {
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

std::unique_ptr<Surface> areal_relief(ArealMap map, const SimulatedSurfaceConfig& config) {
  for (std::size_t i = 0; i < map.height_m.size(); ++i) {
    if (is_plausible(map.height_m[i], map.height_m[0])) continue;
    const std::string where =
        fmt::format("{}: point {} of row {}", config.file, i % map.columns + 1, i / map.columns + 1);
    if (std::isnan(map.height_m[i])) throw Error(where + ": its height is not finite");
    throw implausible(where, map.height_m[i], map.height_m[0]);
  }
  return std::make_unique<ArealRelief>(std::move(map));
}

std::unique_ptr<Surface> read_areal_relief(CsvReader& table, const SimulatedSurfaceConfig& config) {
  return areal_relief(read_areal_map(table, {unit_m(table, 0, 1e-3), unit_m(table, 1, 1e-3),
                                             unit_m(table, 2, 1e-6) * config.file_scale}),
                      config);
}

std::unique_ptr<Surface> profile_relief(std::vector<double> height_m, double spacing_m,
                                        const SimulatedSurfaceConfig& config) {
  if (height_m.size() < 2) throw Error(fmt::format("{}: fewer than two heights", config.file));
  for (std::size_t i = 0; i < height_m.size(); ++i) {
    const std::string where = fmt::format("{}: height {}", config.file, i + 1);
    if (std::isnan(height_m[i])) throw Error(where + " is missing");
    if (!is_plausible(height_m[i], height_m.front())) throw implausible(where, height_m[i], height_m.front());
  }
  return std::make_unique<ProfileRelief>(std::move(height_m), spacing_m);
}

// A profile or a map of an instrument's file.
std::unique_ptr<Surface> instrument_relief(SurfaceFile file, const SimulatedSurfaceConfig& config) {
  for (double& height_m : file.map.height_m) height_m *= config.file_scale;
  if (!file.is_profile()) return areal_relief(std::move(file.map), config);
  return profile_relief(std::move(file.map.height_m), file.map.x_spacing_m, config);
}

std::unique_ptr<Surface> heights_relief(Heights heights, double scale, const SimulatedSurfaceConfig& config) {
  auto* map = std::get_if<ArealMap>(&heights);
  std::vector<double>& height_m = map != nullptr ? map->height_m : std::get<HeightProfile>(heights).height_m;
  for (double& z : height_m) z *= scale;
  if (map != nullptr) return areal_relief(std::move(*map), config);
  return profile_relief(std::move(height_m), std::get<HeightProfile>(heights).spacing_m, config);
}

std::unique_ptr<Surface> tiff_relief(std::string_view bytes, const SimulatedSurfaceConfig& config) {
  constexpr double kRead_m = 1e-9;  // small, so that counts are within what heights may be
  ReadHeightsConfig reading;
  reading.spacing_m = config.file_spacing_m;
  reading.unit = HeightUnit::kNanometre;
  return heights_relief(parse_heights(bytes, config.file, reading), config.file_unit_m / kRead_m * config.file_scale,
                        config);
}

HeightUnit file_unit(const SimulatedSurfaceConfig& config) {
  constexpr std::array<std::pair<double, HeightUnit>, 4> kUnits{{{1e-6, HeightUnit::kMicrometre},
                                                                 {1e-3, HeightUnit::kMillimetre},
                                                                 {1.0, HeightUnit::kMetre},
                                                                 {1e-9, HeightUnit::kNanometre}}};
  const auto found = std::find_if(kUnits.begin(), kUnits.end(), [&](const auto& unit) {
    return std::abs(config.file_unit_m - unit.first) <= 1e-9 * unit.first;
  });
  if (found != kUnits.end()) return found->second;
  throw Error(fmt::format("{}: surface.file_unit_m is {}; of this kind of table it may be 1e-9, 1e-6, 0.001 or 1",
                          config.file, number_text(config.file_unit_m)));
}

// What the other commands read and a plain table is not.
std::unique_ptr<Surface> table_relief(std::string_view text, double spacing_m, const SimulatedSurfaceConfig& config) {
  const ReadHeightsConfig reading{spacing_m, {}, file_unit(config), config.file_units};
  try {
    return heights_relief(parse_heights(text, config.file, reading), config.file_scale, config);
  } catch (const Error& error) {
    std::string message = error.what();  // the reader names its own setting
    if (const auto at = message.find("input.units"); at != std::string::npos)
      message.replace(at, std::string_view("input.units").size(), "surface.file_units");
    throw Error(message);
  }
}

std::unique_ptr<Surface> read_profile_relief(CsvReader& table, const SimulatedSurfaceConfig& config) {
  const std::size_t column = table.width() - 1;
  const double spacing_m = config.file_spacing_m > 0.0 ? config.file_spacing_m : kSpacingOfHeights_m;
  const double scale = unit_m(table, column, config.file_unit_m) * config.file_scale;
  std::vector<double> position;
  std::vector<double> height_m;
  std::vector<std::size_t> lines;
  while (table.next()) {
    position.push_back(table.finite(0));
    height_m.push_back(table.finite(column) * scale);
    lines.push_back(table.line());
    if (!is_plausible(height_m.back(), height_m.front()))
      throw implausible(fmt::format("{}:{}", config.file, table.line()), height_m.back(), height_m.front());
  }
  if (height_m.size() < 2) throw Error(fmt::format("{}: fewer than two heights", config.file));
  if (column == 0) return std::make_unique<ProfileRelief>(std::move(height_m), spacing_m);
  const double first = position.front();
  const double step = (position.back() - first) / static_cast<double>(position.size() - 1);
  if (!(step > 0.0)) throw Error(fmt::format("{}: positions must rise", config.file));
  for (std::size_t i = 0; i < position.size(); ++i) {
    if (std::abs(position[i] - first - step * static_cast<double>(i)) > 0.1 * step) {
      throw Error(
          fmt::format("{}:{}: position {} is not on the uniform grid of {}", config.file, lines[i], position[i], step));
    }
  }
  return std::make_unique<ProfileRelief>(std::move(height_m), step * unit_m(table, 0, 1.0));
}

}  // namespace

std::unique_ptr<Surface> load_surface(const SimulatedSurfaceConfig& config, Problems* problems) {
  if (config.file.empty()) throw Error("simulation.surface.file: empty, but surface.kind is \"file\"");
  std::string bytes = read_file(config.file, kLimitBytes);
  if (auto file = parse_surface_file(bytes, config.file)) {
    if (problems != nullptr) problems->insert(problems->end(), file->problems.begin(), file->problems.end());
    return instrument_relief(std::move(*file), config);
  }
  if (is_tiff(bytes)) return tiff_relief(bytes, config);
  const std::string text = decode_text(std::move(bytes), config.file).text;
  const double spacing_m = config.file_spacing_m > 0.0 ? config.file_spacing_m : kSpacingOfHeights_m;
  if (is_stylus_table(text)) return table_relief(text, spacing_m, config);
  CsvReader table(text, config.file, CsvHeader::kOptional);
  table.accept_unterminated();
  if (table.find("s_m") && table.width() > 2) return table_relief(text, 0.0, config);  // a profile.csv
  if (table.width() > 3) table.fail("more than three columns");
  if (table.width() == 3) return read_areal_relief(table, config);
  if (table.width() == 2 && config.file_spacing_m > 0.0 && is_decimal_comma_table(text))
    return table_relief(text, spacing_m, config);
  return read_profile_relief(table, config);
}

}  // namespace asperity
