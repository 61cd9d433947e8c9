#include <fmt/format.h>
#include <zip.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <pugixml.hpp>

#include "asperity/base/md5.h"
#include "asperity/base/nan.h"
#include "asperity/base/text.h"
#include "surface_formats.h"

namespace asperity {

namespace {

// The members of a zip file in memory, read one by one with a limit: a small file may name a huge one.
class ZipMembers {
 public:
  ZipMembers(std::string_view bytes, const std::string& name) : name_(name) {
    zip_error_t error;
    zip_error_init(&error);
    zip_source_t* source = zip_source_buffer_create(bytes.data(), bytes.size(), 0, &error);
    if (source != nullptr) archive_ = zip_open_from_source(source, ZIP_RDONLY, &error);
    if (archive_ == nullptr) {
      if (source != nullptr) zip_source_free(source);
      zip_error_fini(&error);
      throw Error(name + ": not a whole zip file");
    }
    zip_error_fini(&error);
  }
  ~ZipMembers() { zip_discard(archive_); }
  ZipMembers(const ZipMembers&) = delete;
  ZipMembers& operator=(const ZipMembers&) = delete;

  bool has(const std::string& member) const { return zip_name_locate(archive_, member.c_str(), 0) >= 0; }

  std::string read(const std::string& member, std::size_t most_bytes) const {
    zip_stat_t stat;
    zip_stat_init(&stat);
    if (zip_stat(archive_, member.c_str(), 0, &stat) != 0 || (stat.valid & ZIP_STAT_SIZE) == 0)
      throw Error(name_ + ": " + printable(member) + " is not in it");
    if (stat.size > most_bytes)
      throw Error(fmt::format("{}: {} has {} bytes, more than it may", name_, printable(member), stat.size));
    const std::unique_ptr<zip_file_t, int (*)(zip_file_t*)> file(zip_fopen(archive_, member.c_str(), 0), zip_fclose);
    if (!file) throw Error(name_ + ": " + printable(member) + " cannot be read");
    // The stated size is a claim: memory is taken for what comes out.
    constexpr std::size_t kPiece_bytes = std::size_t{1} << 20U;
    std::string out;
    while (out.size() < stat.size) {
      const std::size_t at = out.size();
      out.resize(std::min<std::size_t>(stat.size, at + std::max(kPiece_bytes, at / 2)));
      const zip_int64_t count = zip_fread(file.get(), out.data() + at, out.size() - at);
      if (count <= 0) throw Error(name_ + ": " + printable(member) + " is damaged");
      out.resize(at + static_cast<std::size_t>(count));
    }
    return out;
  }

 private:
  std::string name_;
  zip_t* archive_ = nullptr;
};

struct Axis {
  char type = 'I';  // incremental or absolute
  char data = 'D';  // I int16, L int32, F float, D double
  double increment_m = 1.0;
  double offset_m = 0.0;
};

Axis read_axis(const pugi::xml_node& axes, const char* axis, const std::string& name) {
  const pugi::xml_node node = axes.child(axis);
  if (!node) throw Error(name + ": main.xml has no axis " + axis);
  Axis out;
  const std::string type(trim(node.child_value("AxisType"))), data(trim(node.child_value("DataType")));
  if (!type.empty()) out.type = type[0];
  if (!data.empty()) out.data = data[0];
  const auto number = [&](const char* key, double fallback) {
    const std::string text = node.child_value(key);
    if (trim(text).empty()) return fallback;
    const auto value = parse_double(text);
    if (!value || !std::isfinite(*value))
      throw Error(fmt::format("{}: {} of axis {} is '{}'", name, key, axis, printable(text)));
    return *value;
  };
  out.increment_m = number("Increment", 1.0);
  out.offset_m = number("Offset", 0.0);
  if (out.increment_m == 0.0) throw Error(fmt::format("{}: Increment of axis {} is 0", name, axis));
  return out;
}

std::size_t size_of(const pugi::xml_node& dimension, const char* key, const std::string& name) {
  const auto value = parse_int64(dimension.child_value(key));
  if (!value || *value < 1)
    throw Error(
        fmt::format("{}: {} is '{}', not a number of points", name, key, printable(dimension.child_value(key))));
  return static_cast<std::size_t>(*value);
}

template <class Number>
void take_heights(const std::string& data, const Axis& z, std::size_t count, const std::string& name, ArealMap& map) {
  if (data.size() != count * sizeof(Number)) {
    throw Error(fmt::format("{}: {} bytes of heights where {} x {} need {}", name, data.size(), map.columns, map.rows,
                            count * sizeof(Number)));
  }
  ByteReader reader(data, name);
  // An absolute axis states metres; an incremental one, and whole numbers, steps of the increment.
  const double step_m = z.type == 'A' && std::is_floating_point_v<Number> ? 1.0 : z.increment_m;
  map.height_m.reserve(count);
  for (std::size_t i = 0; i < count; ++i)
    map.height_m.push_back(static_cast<double>(reader.take<Number>()) * step_m + z.offset_m);
}

// The MD5 sum in a text, in small letters; nullopt for anything else.
std::optional<std::string> stated_md5(std::string_view text) {
  constexpr std::size_t kDigits = 32;
  std::string out(trim(text));
  for (char& c : out) c = c >= 'A' && c <= 'F' ? static_cast<char>(c - 'A' + 'a') : c;
  if (out.size() != kDigits || out.find_first_not_of("0123456789abcdef") != std::string::npos) return {};
  return out;
}

void compare_md5(std::string_view stated, std::string_view content, const std::string& what, const std::string& where,
                 const std::string& name, Problems& problems) {
  const auto sum = stated_md5(stated);
  if (!sum) return;
  const std::string has = md5_hex(content);
  if (has == *sum) return;
  problems.push_back(
      {"checksum",
       fmt::format("{}: {} has the MD5 sum {}, but {} states {}: it was changed after it was written, or "
                   "is damaged",
                   name, printable(what, 100), has, printable(where, 100), *sum),
       1});
}

// Lines "sum *main.xml", or a sum alone.
void check_main_xml(const ZipMembers& members, const pugi::xml_node& root, const std::string& xml,
                    const std::string& name, Problems& problems) {
  constexpr std::size_t kMost_bytes = 65536, kSum = 32;
  std::string file(trim(root.child("Record4").child_value("ChecksumFile")));
  if (file.empty()) file = "md5checksum.hex";
  if (!members.has(file)) return;
  std::string content;
  try {
    content = members.read(file, kMost_bytes);
  } catch (const Error& error) {
    problems.push_back({"checksum", error.what(), 1});  // of the sum alone: the heights are read all the same
    return;
  }
  for (std::string_view rest = content; !rest.empty();) {
    const std::string_view line = trim(rest.substr(0, rest.find('\n')));
    rest.remove_prefix(
        std::min(rest.size(), rest.find('\n') == std::string_view::npos ? rest.size() : rest.find('\n') + 1));
    std::string_view of = trim(line.substr(std::min(kSum, line.size())));
    if (of.starts_with('*')) of.remove_prefix(1);
    if (of.starts_with("./")) of.remove_prefix(2);
    if (!of.empty() && of != "main.xml") continue;
    const std::string_view sum = line.substr(0, std::min(kSum, line.size()));
    if (!stated_md5(sum)) continue;
    // One is enough: the file may be large, and state as many sums as it likes.
    return compare_md5(sum, xml, "main.xml", file, name, problems);
  }
}

void take_binary(const std::string& data, const Axis& z, std::size_t count, const std::string& name, ArealMap& map) {
  switch (z.data) {
    case 'I':
      return take_heights<std::int16_t>(data, z, count, name, map);
    case 'L':
      return take_heights<std::int32_t>(data, z, count, name, map);
    case 'F':
      return take_heights<float>(data, z, count, name, map);
    case 'D':
      return take_heights<double>(data, z, count, name, map);
    default:
      throw Error(fmt::format("{}: the heights are of type '{}'; I, L, F and D are read", name, z.data));
  }
}

// Heights as text: a Datum each, three numbers separated by ; of which z is the last. An empty one is missing.
void take_text(const pugi::xml_node& list, const Axis& z, std::size_t count, const std::string& name, ArealMap& map) {
  for (const pugi::xml_node& datum : list.children("Datum")) {
    if (map.height_m.size() == count) throw Error(name + ": more heights than the grid has");
    const std::string_view text = datum.child_value();
    const std::size_t last = text.find_last_of(';');
    const std::string_view cell = trim(last == std::string_view::npos ? text : text.substr(last + 1));
    if (cell.empty()) {
      map.height_m.push_back(kNan);
      continue;
    }
    const auto value = parse_double(cell);
    if (!value) {
      throw Error(fmt::format("{}: height {} of main.xml is '{}'", name, map.height_m.size() + 1, printable(cell)));
    }
    map.height_m.push_back(*value * (z.type == 'A' ? 1.0 : z.increment_m) + z.offset_m);
  }
  if (map.height_m.size() != count)
    throw Error(fmt::format("{}: {} heights where the grid has {}", name, map.height_m.size(), count));
}

// One bit for each height, the first the lowest of the first byte; 0 is missing.
void take_mask(const std::string& bits, const std::string& name, ArealMap& map) {
  if (bits.size() < (map.height_m.size() + 7) / 8) throw Error(name + ": the mask of valid points is too short");
  for (std::size_t i = 0; i < map.height_m.size(); ++i) {
    if ((static_cast<unsigned char>(bits[i / 8]) >> (i % 8) & 1U) == 0) map.height_m[i] = kNan;
  }
}

}  // namespace

bool is_x3p(std::string_view bytes) { return bytes.starts_with("PK\x03\x04"); }

SurfaceFile parse_x3p(std::string_view bytes, const std::string& name) {
  const ZipMembers members(bytes, name);
  // As elements that are as short as can be it becomes twenty times as much in memory.
  constexpr std::size_t kMostXml_bytes = std::size_t{64} << 20U;
  const std::string xml = members.read("main.xml", kMostXml_bytes);
  pugi::xml_document document;
  if (const auto parsed = document.load_buffer(xml.data(), xml.size()); !parsed)
    throw Error(fmt::format("{}: main.xml: {} at byte {}", name, parsed.description(), parsed.offset));
  const pugi::xml_node root = document.document_element();
  const pugi::xml_node axes = root.child("Record1").child("Axes");
  const pugi::xml_node record = root.child("Record3");
  const Axis x = read_axis(axes, "CX", name), z = read_axis(axes, "CZ", name);
  const std::string feature(trim(root.child("Record1").child_value("FeatureType")));
  if (feature != "SUR" && feature != "PRF")
    throw Error(name + ": the feature is '" + printable(feature) + "'; SUR and PRF are read");
  const pugi::xml_node dimension = record.child("MatrixDimension");
  SurfaceFile out;
  out.format = "X3P";
  check_main_xml(members, root, xml, name, out.problems);
  out.map.columns = size_of(dimension, "SizeX", name);
  out.map.rows = size_of(dimension, "SizeY", name);
  if (size_of(dimension, "SizeZ", name) != 1) throw Error(name + ": more than one layer (SizeZ); one is read");
  const std::size_t count = checked_count(out.map.columns, out.map.rows, name);
  if (x.type != 'I') throw Error(name + ": the points are not evenly spaced along x; even grids are read");
  out.map.x_spacing_m = checked_spacing_m(x.increment_m, "the increment of CX", name);
  if (!out.is_profile()) {
    const Axis y = read_axis(axes, "CY", name);
    if (y.type != 'I') throw Error(name + ": the points are not evenly spaced along y; even grids are read");
    out.map.y_spacing_m = checked_spacing_m(y.increment_m, "the increment of CY", name);
  }
  const pugi::xml_node link = record.child("DataLink");
  if (link) {
    const std::string points(trim(link.child_value("PointDataLink")));
    const std::string data = members.read(points, count * sizeof(double));
    compare_md5(link.child_value("MD5ChecksumPointData"), data, points, "MD5ChecksumPointData of main.xml", name,
                out.problems);
    take_binary(data, z, count, name, out.map);
    const std::string mask(trim(link.child_value("ValidPointsLink")));
    // Some writers fill up its end; one byte a point is more than any does.
    constexpr std::size_t kLeastMask_bytes = 4096;
    if (!mask.empty()) {
      const std::string bits = members.read(mask, std::max(count, kLeastMask_bytes));
      compare_md5(link.child_value("MD5ChecksumValidPoints"), bits, mask, "MD5ChecksumValidPoints of main.xml", name,
                  out.problems);
      take_mask(bits, name, out.map);
    }
  } else {
    take_text(record.child("DataList"), z, count, name, out.map);
  }
  return out;
}

}  // namespace asperity
