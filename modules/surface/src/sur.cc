#include <fmt/format.h>

#include <cmath>

#include "asperity/base/nan.h"
#include "asperity/base/text.h"
#include "surface_formats.h"

namespace asperity {

namespace {

// The fixed header of 512 bytes, as far as heights need it.
struct SurHeader {
  int objects = 0, type = 0, special_points = 0, bits = 0;
  std::int32_t lowest = 0;
  std::int32_t columns = 0, rows = 0;
  float x_step = 0.0F, y_step = 0.0F, z_step = 0.0F, z_offset = 0.0F;
  std::string x_unit, y_unit, z_unit;
  int comment_bytes = 0, private_bytes = 0;
};

SurHeader take_header(ByteReader& reader) {
  SurHeader out;
  reader.skip(12 + 2);  // signature, format
  out.objects = reader.take<std::int16_t>();
  reader.skip(2);  // version
  out.type = reader.take<std::int16_t>();
  reader.skip(30 + 30 + 2 + 2 + 2);  // names, material, acquisition, range
  out.special_points = reader.take<std::int16_t>();
  reader.skip(2 + 4 + 4);  // absolute, gauge resolution, reserved
  out.bits = reader.take<std::int16_t>();
  out.lowest = reader.take<std::int32_t>();
  reader.skip(4);  // the highest
  out.columns = reader.take<std::int32_t>();
  out.rows = reader.take<std::int32_t>();
  reader.skip(4);  // points in all
  out.x_step = reader.take<float>();
  out.y_step = reader.take<float>();
  out.z_step = reader.take<float>();
  reader.skip(3 * 16);  // the axes' names
  out.x_unit = reader.text(16);
  out.y_unit = reader.text(16);
  out.z_unit = reader.text(16);
  reader.skip(3 * 16 + 3 * 4 + 3 * 2 + 12 + 7 * 2 + 4 + 10);  // units of lengths, ratios, processing, reserved, date
  out.comment_bytes = reader.take<std::int16_t>();
  out.private_bytes = reader.take<std::int16_t>();
  reader.skip(128 + 2 * 4);  // the client's, offsets of x and y
  out.z_offset = reader.take<float>();
  reader.skip(34);
  return out;
}

template <class Number>
void take_heights(ByteReader& reader, const SurHeader& header, double unit_m, std::size_t count, SurfaceFile& out) {
  out.map.height_m.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const auto value = static_cast<std::int64_t>(reader.take<Number>());
    const bool missing = header.special_points == 1 && value == std::int64_t{header.lowest} - 2;
    out.map.height_m.push_back(missing ? kNan
                                       : (static_cast<double>(value) * static_cast<double>(header.z_step) +
                                          static_cast<double>(header.z_offset)) *
                                             unit_m);
  }
}

}  // namespace

bool is_sur(std::string_view bytes) { return bytes.starts_with("DIGITAL SURF") || bytes.starts_with("DSCOMPRESSED"); }

SurfaceFile parse_sur(std::string_view bytes, const std::string& name) {
  if (bytes.starts_with("DSCOMPRESSED"))
    throw Error(name + ": a compressed SUR file is not read here: save it without compression, as X3P or as SDF");
  ByteReader reader(bytes, name);
  const SurHeader header = take_header(reader);
  constexpr int kProfile = 1, kSurface = 2;
  if (header.objects > 1 || (header.type != kProfile && header.type != kSurface)) {
    throw Error(fmt::format("{}: {} objects of type {}; one profile (1) or one surface (2) is read", name,
                            header.objects, header.type));
  }
  if (header.columns < 1 || header.rows < 1 || header.comment_bytes < 0 || header.private_bytes < 0)
    throw Error(fmt::format("{}: a grid of {} x {} heights", name, header.columns, header.rows));
  SurfaceFile out;
  out.format = "SUR";
  out.map.columns = static_cast<std::size_t>(header.columns);
  out.map.rows = static_cast<std::size_t>(header.rows);
  const std::size_t count = checked_count(out.map.columns, out.map.rows, name);
  const auto spacing_m = [&](float step, const std::string& unit, const char* axis) {
    return checked_spacing_m(static_cast<double>(step) * length_unit_m(unit, axis, name),
                             std::string("the spacing along ") + axis, name);
  };
  out.map.x_spacing_m = spacing_m(header.x_step, header.x_unit, "x");
  if (!out.is_profile()) out.map.y_spacing_m = spacing_m(header.y_step, header.y_unit, "y");
  const double z_m = length_unit_m(header.z_unit, "the heights", name);
  if (header.z_step == 0.0F || !std::isfinite(header.z_step) || !std::isfinite(header.z_offset)) {
    throw Error(
        fmt::format("{}: the step of the heights is {} and their offset {}", name, header.z_step, header.z_offset));
  }
  reader.skip(static_cast<std::size_t>(header.comment_bytes) + static_cast<std::size_t>(header.private_bytes));
  if (header.bits != 16 && header.bits != 32)
    throw Error(fmt::format("{}: heights of {} bits; 16 or 32 are read", name, header.bits));
  const std::size_t need = count * static_cast<std::size_t>(header.bits) / 8;
  if (reader.left() < need)
    throw Error(fmt::format("{}: {} bytes of heights where {} are needed", name, reader.left(), need));
  if (header.bits == 16) {
    take_heights<std::int16_t>(reader, header, z_m, count, out);
  } else {
    take_heights<std::int32_t>(reader, header, z_m, count, out);
  }
  return out;
}

}  // namespace asperity
