#include "asperity/surface/format_surface_file.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "asperity/base/error.h"
#include "asperity/base/little_endian.h"
#include "asperity/base/nan.h"
#include "asperity/base/text.h"
#include "surface_formats.h"

namespace asperity {

namespace {

void check(const ArealMap& map, const std::string& format) {
  if (map.height_m.size() != checked_count(map.columns, map.rows, format)) {
    throw Error(
        fmt::format("{}: {} heights for a grid of {} x {}", format, map.height_m.size(), map.columns, map.rows));
  }
  checked_spacing_m(map.x_spacing_m, "the spacing along x", format);
  if (map.rows > 1) checked_spacing_m(map.y_spacing_m, "the spacing along y", format);
  for (const double z : map.height_m) {
    if (std::isinf(z)) throw Error(format + ": a height is infinite");
  }
}

double y_spacing_m(const ArealMap& map) { return map.rows > 1 ? map.y_spacing_m : map.x_spacing_m; }

}  // namespace

std::string format_gsf(const ArealMap& map) {
  check(map, "GSF");
  std::string out =
      fmt::format("Gwyddion Simple Field 1.0\nXRes = {}\nYRes = {}\nXReal = {}\nYReal = {}\nXYUnits = m\nZUnits = m\n",
                  map.columns, map.rows, number_text(map.x_spacing_m * static_cast<double>(map.columns)),
                  number_text(y_spacing_m(map) * static_cast<double>(map.rows)));
  out.append(4 - out.size() % 4, '\0');  // one to four
  out.reserve(out.size() + 4 * map.height_m.size());
  for (const double z : map.height_m) {
    append_little_endian(out, std::isnan(z) ? std::numeric_limits<float>::quiet_NaN() : static_cast<float>(z));
  }
  return out;
}

std::string format_sdf(const ArealMap& map, SdfForm form) {
  check(map, "SDF");
  if (form == SdfForm::kText) {
    std::string out = fmt::format(
        "aISO-1.0\nManufacID = asperity\nCreateDate = 000000000000\nModDate = 000000000000\nNumPoints = {}\n"
        "NumProfiles = {}\nXscale = {}\nYscale = {}\nZscale = 1\nZresolution = -1\nCompression = 0\nDataType = 7\n"
        "CheckType = 0\n*\n",
        map.columns, map.rows, number_text(map.x_spacing_m), number_text(y_spacing_m(map)));
    for (std::size_t row = 0; row < map.rows; ++row) {
      for (std::size_t column = 0; column < map.columns; ++column) {
        const double z = map.at(row, column);
        out += std::isnan(z) ? std::string("BAD") : number_text(z);
        out += column + 1 < map.columns ? ' ' : '\n';
      }
    }
    return out + "*\n";
  }
  constexpr std::size_t kMost = std::numeric_limits<std::uint16_t>::max();
  if (map.columns > kMost || map.rows > kMost) {
    throw Error(
        fmt::format("SDF: a grid of {} x {}; the binary form holds {} at most along each side, the text form more",
                    map.columns, map.rows, kMost));
  }
  std::string out = "bISO-1.0asperity  000000000000000000000000";
  append_little_endian(out, static_cast<std::uint16_t>(map.columns));
  append_little_endian(out, static_cast<std::uint16_t>(map.rows));
  for (const double x : {map.x_spacing_m, y_spacing_m(map), 1.0, -1.0}) append_little_endian(out, x);
  out += '\0';  // not compressed
  out += '\7';  // doubles
  out += '\0';  // no check sum
  out.reserve(out.size() + 8 * map.height_m.size());
  for (const double z : map.height_m) append_little_endian(out, std::isnan(z) ? kNan : z);
  return out;
}

}  // namespace asperity
