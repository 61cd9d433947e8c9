#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "asperity/base/nan.h"
#include "asperity/base/text.h"
#include "surface_formats.h"

namespace asperity {

namespace {

constexpr std::size_t kVersion_bytes = 8;

// What both forms of the header state.
struct SdfHeader {
  std::size_t columns = 0, rows = 0;
  double x_m = 0.0, y_m = 0.0, z_m = 0.0;
  int compression = 0, type = 0;
};

SurfaceFile begin(const SdfHeader& header, const std::string& name) {
  if (header.compression != 0)
    throw Error(fmt::format("{}: its data are compressed ({}), which SDF does not define", name, header.compression));
  SurfaceFile out;
  out.format = "SDF";
  out.map.columns = header.columns;
  out.map.rows = header.rows;
  checked_count(header.columns, header.rows, name);
  out.map.x_spacing_m = checked_spacing_m(header.x_m, "Xscale", name);
  if (!out.is_profile()) out.map.y_spacing_m = checked_spacing_m(header.y_m, "Yscale", name);
  if (!(header.z_m > 0.0) || !std::isfinite(header.z_m))
    throw Error(name + ": Zscale is " + number_text(header.z_m) + " m");
  return out;
}

template <class Number>
void take_heights(ByteReader& reader, double z_m, std::size_t count, const std::string& name, ArealMap& map) {
  if (reader.left() < count * sizeof(Number)) {
    throw Error(fmt::format("{}: {} bytes of heights where {} x {} need {}", name, reader.left(), map.columns, map.rows,
                            count * sizeof(Number)));
  }
  map.height_m.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const auto value = static_cast<double>(reader.take<Number>());
    // The largest number of the type stands for none too.
    const bool missing = std::is_floating_point_v<Number> && !(std::abs(value) < 1e30);
    map.height_m.push_back(missing ? kNan : value * z_m);
  }
}

SurfaceFile parse_binary(std::string_view bytes, const std::string& name) {
  ByteReader reader(bytes, name);
  reader.skip(kVersion_bytes + 10 + 12 + 12);  // version, manufacturer, created, modified
  SdfHeader header;
  header.columns = reader.take<std::uint16_t>();
  header.rows = reader.take<std::uint16_t>();
  header.x_m = reader.take<double>();
  header.y_m = reader.take<double>();
  header.z_m = reader.take<double>();
  reader.skip(sizeof(double));  // the resolution of z
  header.compression = reader.take<std::uint8_t>();
  header.type = reader.take<std::uint8_t>();
  reader.skip(1);  // the kind of check sum
  SurfaceFile out = begin(header, name);
  const std::size_t count = header.columns * header.rows;
  switch (header.type) {
    case 0:
      take_heights<std::uint8_t>(reader, header.z_m, count, name, out.map);
      break;
    case 1:
      take_heights<std::uint16_t>(reader, header.z_m, count, name, out.map);
      break;
    case 2:
      take_heights<std::uint32_t>(reader, header.z_m, count, name, out.map);
      break;
    case 3:
      take_heights<float>(reader, header.z_m, count, name, out.map);
      break;
    case 4:
      take_heights<std::int8_t>(reader, header.z_m, count, name, out.map);
      break;
    case 5:
      take_heights<std::int16_t>(reader, header.z_m, count, name, out.map);
      break;
    case 6:
      take_heights<std::int32_t>(reader, header.z_m, count, name, out.map);
      break;
    case 7:
      take_heights<double>(reader, header.z_m, count, name, out.map);
      break;
    default:
      throw Error(fmt::format("{}: its data are of type {}; SDF has 0 to 7", name, header.type));
  }
  return out;
}

// "name = value" lines up to one of a single *; names without regard to case, as programs differ in it.
std::map<std::string, std::string, std::less<>> text_header(std::string_view& rest, std::size_t& line,
                                                            const std::string& name) {
  std::map<std::string, std::string, std::less<>> out;
  while (!rest.empty()) {
    const std::string_view whole = rest.substr(0, rest.find('\n'));
    rest.remove_prefix(std::min(rest.size(), whole.size() + 1));
    const std::string_view text = trim(whole.substr(0, whole.find('\r')));
    ++line;
    if (text == "*") return out;
    if (text.empty()) continue;
    const std::size_t equals = text.find('=');
    if (equals == std::string_view::npos)
      throw Error(fmt::format("{}:{}: '{}' is not of the form name = value", name, line, printable(text)));
    std::string key(trim(text.substr(0, equals)));
    for (char& c : key) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    out[key] = std::string(trim(text.substr(equals + 1)));
  }
  throw Error(name + ": the header does not end in a line with *");
}

SurfaceFile parse_text(std::string_view bytes, const std::string& name) {
  std::string_view rest = bytes;
  const std::string_view first = rest.substr(0, rest.find('\n'));
  rest.remove_prefix(std::min(rest.size(), first.size() + 1));
  std::size_t line = 1;
  auto fields = text_header(rest, line, name);
  ++line;  // the first one of data
  const auto number = [&](const char* key) {
    const auto value = parse_double(fields[key]);
    if (!value) throw Error(fmt::format("{}: {} is '{}', not a number", name, key, printable(fields[key])));
    return *value;
  };
  const auto whole = [&](const char* key) {
    const auto value = parse_int64(fields[key]);
    if (!value || *value < 0) throw Error(fmt::format("{}: {} is '{}'", name, key, printable(fields[key])));
    return static_cast<std::size_t>(*value);
  };
  SdfHeader header{whole("numpoints"), whole("numprofiles"), number("xscale"), number("yscale"), number("zscale")};
  if (!fields["compression"].empty()) header.compression = static_cast<int>(whole("compression"));
  SurfaceFile out = begin(header, name);
  const std::size_t count = header.columns * header.rows;
  if (rest.size() / 2 < count - 1)
    throw Error(fmt::format("{}: too short for {} x {} heights", name, header.columns, header.rows));
  out.map.height_m.reserve(count);
  while (out.map.height_m.size() < count) {
    while (!rest.empty() && std::string_view(" \t\r\n,;").find(rest.front()) != std::string_view::npos) {
      line += rest.front() == '\n' ? 1 : 0;
      rest.remove_prefix(1);
    }
    const std::string_view word = rest.substr(0, rest.find_first_of(" \t\r\n,;"));
    rest.remove_prefix(word.size());
    if (word == "BAD" || word == "bad") {
      out.map.height_m.push_back(kNan);
      continue;
    }
    const auto value = parse_double(word);
    if (!value) {
      throw Error(fmt::format("{}:{}: '{}' where height {} of {} was expected", name, line, printable(word),
                              out.map.height_m.size() + 1, count));
    }
    out.map.height_m.push_back(*value * header.z_m);
  }
  // A '*' ends the heights; the trailer behind it is free text.
  const std::size_t next = rest.find_first_not_of(" \t\r\n,;");
  if (next != std::string_view::npos && rest[next] != '*') {
    line += static_cast<std::size_t>(std::count(rest.begin(), rest.begin() + static_cast<std::ptrdiff_t>(next), '\n'));
    const std::string_view word = rest.substr(next, rest.find_first_of(" \t\r\n,;", next) - next);
    throw Error(fmt::format("{}:{}: '{}' behind the {} heights of its {} x {} points", name, line, printable(word),
                            count, header.columns, header.rows));
  }
  return out;
}

}  // namespace

bool is_sdf(std::string_view bytes) {
  const std::string_view version = bytes.substr(0, kVersion_bytes);
  return version == "aISO-1.0" || version == "bISO-1.0" || version == "aBCR-1.0" || version == "bBCR-1.0";
}

SurfaceFile parse_sdf(std::string_view bytes, const std::string& name) {
  return bytes.front() == 'a' ? parse_text(bytes, name) : parse_binary(bytes, name);
}

}  // namespace asperity
