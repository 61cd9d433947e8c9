#include "asperity/scene/covered_triangles.h"

#include <array>
#include <limits>
#include <set>

#include "asperity/base/csv.h"
#include "asperity/base/text.h"

namespace asperity {

namespace {

constexpr std::array<const char*, 6> kCornerColumns{"x1_mm", "y1_mm", "x2_mm", "y2_mm", "x3_mm", "y3_mm"};

}  // namespace

std::string format_covered_triangles(std::span<const CoveredTriangle> covered) {
  std::string out = "triangle,texture";
  for (const char* column : kCornerColumns) out += std::string(",") + column;
  out += '\n';
  for (const CoveredTriangle& one : covered) {
    append_number(out, static_cast<std::int64_t>(one.triangle));
    out += ',';
    append_number(out, static_cast<std::int64_t>(one.haptic.texture));
    for (const Eigen::Vector2d& corner : one.haptic.xy_mm) {
      for (const double value : corner) {
        out += ',';
        append_number(out, value);
      }
    }
    out += '\n';
  }
  return out;
}

std::vector<CoveredTriangle> parse_covered_triangles(std::string_view text, const std::string& name,
                                                     std::size_t triangles) {
  CsvReader csv(text, name);
  csv.accept_unterminated();
  const std::size_t triangle = csv.require("triangle"), texture = csv.require("texture");
  std::array<std::size_t, 6> columns{};
  for (std::size_t k = 0; k < columns.size(); ++k) columns[k] = csv.require(kCornerColumns[k]);
  std::vector<CoveredTriangle> out;
  std::set<std::int32_t> of_triangle;  // the textures of the last one
  while (csv.next()) {
    const std::int64_t t = csv.integer(triangle), index = csv.integer(texture);
    if (t < 0 || static_cast<std::uint64_t>(t) >= triangles)
      csv.fail(triangle, std::to_string(t) + " is not a triangle of a mesh that has " + std::to_string(triangles));
    if (!out.empty() && static_cast<std::uint32_t>(t) < out.back().triangle)
      csv.fail(triangle, "triangle " + std::to_string(t) + " comes after " + std::to_string(out.back().triangle));
    if (index < 0 || index > std::numeric_limits<std::int32_t>::max())
      csv.fail(texture, std::to_string(index) + " is not the index of a texture");
    CoveredTriangle one;
    one.triangle = static_cast<std::uint32_t>(t);
    one.haptic.texture = static_cast<std::int32_t>(index);
    if (!out.empty() && out.back().triangle != one.triangle) of_triangle.clear();
    if (!of_triangle.insert(one.haptic.texture).second)
      csv.fail(texture, "texture " + std::to_string(index) + " is on triangle " + std::to_string(t) + " twice");
    for (std::size_t k = 0; k < columns.size(); ++k)
      one.haptic.xy_mm[k / 2][static_cast<Eigen::Index>(k % 2)] = csv.finite(columns[k]);
    out.push_back(one);
  }
  return out;
}

}  // namespace asperity
