#include <fmt/format.h>

#include <map>

#include "asperity/base/text.h"
#include "surface_formats.h"

namespace asperity {

namespace {

constexpr std::string_view kMagic = "Gwyddion Simple Field 1.0\n";

}  // namespace

bool is_gsf(std::string_view bytes) { return bytes.starts_with(kMagic); }

SurfaceFile parse_gsf(std::string_view bytes, const std::string& name) {
  const std::size_t end = bytes.find('\0');
  if (end == std::string_view::npos) throw Error(name + ": the header of the GSF file does not end");
  std::map<std::string, std::string, std::less<>> fields;
  std::string_view header = bytes.substr(kMagic.size(), end - kMagic.size());
  for (std::size_t line = 2; !header.empty(); ++line) {
    const std::string_view text = header.substr(0, header.find('\n'));
    header.remove_prefix(std::min(header.size(), text.size() + 1));
    const std::size_t equals = text.find('=');
    if (equals == std::string_view::npos)
      throw Error(fmt::format("{}:{}: '{}' is not of the form name = value", name, line, printable(text)));
    fields[std::string(trim(text.substr(0, equals)))] = std::string(trim(text.substr(equals + 1)));
  }
  const auto whole = [&](const char* key) {
    const auto value = parse_int64(fields[key]);
    if (!value || *value < 1)
      throw Error(fmt::format("{}: {} is '{}', not a number of points", name, key, printable(fields[key])));
    return static_cast<std::size_t>(*value);
  };
  const auto extent = [&](const char* key) {
    const auto value = parse_double(fields[key]);
    if (!value) throw Error(fmt::format("{}: {} is missing or not a number: the spacing is not known", name, key));
    return *value;
  };
  SurfaceFile out;
  out.format = "GSF";
  out.map.columns = whole("XRes");
  out.map.rows = whole("YRes");
  const std::size_t count = checked_count(out.map.columns, out.map.rows, name);
  // Without a unit lengths would be pure numbers, which no relief has.
  const double xy_m = length_unit_m(fields["XYUnits"], "x and y (XYUnits)", name);
  const double z_m = length_unit_m(fields["ZUnits"], "the heights (ZUnits)", name);
  out.map.x_spacing_m =
      checked_spacing_m(extent("XReal") * xy_m / static_cast<double>(out.map.columns), "the spacing along x", name);
  if (!out.is_profile()) {
    out.map.y_spacing_m =
        checked_spacing_m(extent("YReal") * xy_m / static_cast<double>(out.map.rows), "the spacing along y", name);
  }
  const std::size_t padded = end + (4 - end % 4);
  if (bytes.size() < padded) throw Error(name + ": the file ends before its heights");
  ByteReader reader(bytes.substr(padded), name);
  if (reader.left() != count * sizeof(float)) {
    throw Error(fmt::format("{}: {} bytes of heights where {} x {} need {}", name, reader.left(), out.map.columns,
                            out.map.rows, count * sizeof(float)));
  }
  out.map.height_m.reserve(count);
  for (std::size_t i = 0; i < count; ++i) out.map.height_m.push_back(static_cast<double>(reader.take<float>()) * z_m);
  return out;
}

}  // namespace asperity
