#include "asperity/scene/material_map.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "asperity/base/csv.h"
#include "asperity/base/error.h"
#include "asperity/base/text.h"

namespace asperity {

namespace {

struct Mean {
  double sum = 0.0;
  int count = 0;

  void add(double value) {
    if (!std::isfinite(value)) return;
    sum += value;
    ++count;
  }
  double value() const { return count > 0 ? sum / count : std::numeric_limits<double>::quiet_NaN(); }
};

bool is_known(const Material& material) {
  return std::isfinite(material.compliance_kc) || std::isfinite(material.stiffness_N_per_m) ||
         std::isfinite(material.friction) || std::isfinite(material.static_friction_ratio);
}

// An empty cell or nan is not known.
double cell_between(const CsvReader& csv, std::size_t column, double low, double high, const char* what) {
  if (csv.empty(column)) return std::numeric_limits<double>::quiet_NaN();
  const double value = csv.number(column);
  if (std::isnan(value)) return value;
  if (!(value >= low && value <= high)) csv.fail(column, "'" + printable(csv.cell(column)) + "' is not " + what);
  return value;
}

}  // namespace

MaterialMap spread_materials(std::size_t vertices, std::span<const Triangle> triangles,
                             std::span<const HapticTriangle> haptic, std::span<const int> textures,
                             std::span<const Material> materials) {
  if (haptic.size() != triangles.size() || textures.size() != materials.size()) {
    throw Error("material map: " + std::to_string(triangles.size()) + " triangles, " + std::to_string(haptic.size()) +
                " coordinates, " + std::to_string(textures.size()) + " textures, " + std::to_string(materials.size()) +
                " materials");
  }
  std::vector<std::array<Mean, 4>> means(vertices);
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const auto at = std::find(textures.begin(), textures.end(), haptic[t].texture);
    if (at == textures.end()) continue;
    const Material& material = materials[static_cast<std::size_t>(at - textures.begin())];
    for (const std::uint32_t vertex : triangles[t]) {
      if (vertex >= vertices) throw Error("material map: vertex " + std::to_string(vertex) + " is out of range");
      means[vertex][0].add(material.compliance_kc);
      means[vertex][1].add(material.stiffness_N_per_m);
      means[vertex][2].add(material.friction);
      means[vertex][3].add(material.static_friction_ratio);
    }
  }
  MaterialMap map;
  map.vertices.reserve(vertices);
  for (const auto& [compliance, stiffness, friction, ratio] : means) {
    map.vertices.push_back({compliance.value(), stiffness.value(), friction.value(), ratio.value()});
  }
  return map;
}

std::string format_material_map(const MaterialMap& map) {
  const bool with_ratio = std::any_of(map.vertices.begin(), map.vertices.end(), [](const Material& material) {
    return std::isfinite(material.static_friction_ratio);
  });
  std::string out = "vertex,compliance_kc,stiffness_N_per_m,friction";
  out += with_ratio ? ",static_friction_ratio\n" : "\n";
  for (std::size_t i = 0; i < map.vertices.size(); ++i) {
    const Material& material = map.vertices[i];
    if (!is_known(material)) continue;
    append_number(out, static_cast<std::int64_t>(i));
    for (const double value : {material.compliance_kc, material.stiffness_N_per_m, material.friction}) {
      out += ',';
      if (std::isfinite(value)) append_number(out, value);
    }
    if (with_ratio) out += ',';
    if (std::isfinite(material.static_friction_ratio)) append_number(out, material.static_friction_ratio);
    out += '\n';
  }
  return out;
}

MaterialMap parse_material_map(std::string_view text, const std::string& name, std::size_t vertices) {
  CsvReader csv(text, name);
  csv.accept_unterminated();
  const std::size_t vertex = csv.require("vertex");
  const std::size_t compliance = csv.require("compliance_kc");
  const std::size_t stiffness = csv.require("stiffness_N_per_m");
  const std::size_t friction = csv.require("friction");
  const auto ratio = csv.find("static_friction_ratio");
  constexpr double kStiffest_N_per_m = 1e12, kRoughest = 1e3;  // larger ones are a mistake of unit
  MaterialMap map;
  map.vertices.resize(vertices);
  std::vector<char> given(vertices, 0);
  while (csv.next()) {
    const std::int64_t index = csv.integer(vertex);
    if (index < 0 || static_cast<std::uint64_t>(index) >= vertices) {
      csv.fail(vertex, std::to_string(index) + " is not a vertex of a mesh that has " + std::to_string(vertices));
    }
    const auto at = static_cast<std::size_t>(index);
    if (given[at] != 0) csv.fail(vertex, "vertex " + std::to_string(index) + " is given twice");
    given[at] = 1;
    map.vertices[at] = {
        cell_between(csv, compliance, 0.0, 1.0, "within 0 and 1"),
        cell_between(csv, stiffness, std::numeric_limits<double>::min(), kStiffest_N_per_m, "a stiffness in N/m"),
        cell_between(csv, friction, 0.0, kRoughest, "a coefficient of friction"),
        ratio ? cell_between(csv, *ratio, 1.0, kRoughest, "a ratio from 1") : std::numeric_limits<double>::quiet_NaN()};
  }
  return map;
}

}  // namespace asperity
