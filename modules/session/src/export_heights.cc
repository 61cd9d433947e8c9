#include "asperity/session/export_heights.h"

#include <algorithm>
#include <array>
#include <set>
#include <string>
#include <utility>
#include <variant>

#include "asperity/base/nan.h"
#include "asperity/base/version.h"
#include "asperity/scene/format_x3p.h"
#include "asperity/session/export_files.h"
#include "asperity/surface/format_surface_file.h"
#include "asperity/texture/evaluate_height.h"

namespace asperity {

namespace fs = std::filesystem;

namespace {

std::string bytes_of(const ArealMap& map, HeightFile format) {
  switch (format) {
    case HeightFile::kX3p:
      return format_x3p({map.columns, map.rows, map.x_spacing_m, map.y_spacing_m, map.height_m,
                         std::string("asperity ") + kVersion + ": heights at their own spacing; nan is missing."});
    case HeightFile::kSdf:
      return format_sdf(map, SdfForm::kText);
    case HeightFile::kSdfBinary:
      return format_sdf(map, SdfForm::kBinary);
    case HeightFile::kGsf:
      return format_gsf(map);
  }
  return {};
}

ArealMap read_map(const fs::path& file, const ReadHeightsConfig& reading, Problems& problems) {
  HeightsOrigin origin;
  Heights heights = read_heights(file, reading, &problems, &origin);
  if (origin.units.height.origin == UnitOrigin::kAssumed) problems.push_back({"warning", units_text(origin.units), 1});
  if (auto* map = std::get_if<ArealMap>(&heights)) return std::move(*map);
  auto& profile = std::get<HeightProfile>(heights);
  const std::size_t count = profile.height_m.size();
  return {profile.spacing_m, 0.0, count, 1, std::move(profile.height_m)};
}

// The heights at the points of the splines that have two more on each side.
ArealMap map_of(const ArealTexture& areal) {
  const SplineGrid& g = areal.surface;
  ArealMap map{g.spacing_x_m,
               g.spacing_y_m,
               g.columns - std::min<std::size_t>(4, g.columns),
               g.rows - std::min<std::size_t>(4, g.rows),
               {}};
  const TextureModel model = areal;
  for (std::size_t row = 2; row < map.rows + 2; ++row) {
    for (std::size_t column = 2; column < map.columns + 2; ++column) {
      const double x_m = g.origin_x_m + static_cast<double>(column) * g.spacing_x_m;
      const double y_m = g.origin_y_m + static_cast<double>(row) * g.spacing_y_m;
      map.height_m.push_back(areal.supported[row * g.columns + column] != 0 ? evaluate_height(model, x_m, y_m).height_m
                                                                            : kNan);
    }
  }
  return map;
}

}  // namespace

std::optional<HeightFile> height_file_of(std::string_view name) {
  const auto found = std::find(kHeightFileNames.begin(), kHeightFileNames.end(), name);
  if (found == kHeightFileNames.end()) return std::nullopt;
  return static_cast<HeightFile>(found - kHeightFileNames.begin());
}

bool holds_heights_alone(const fs::path& source) {
  if (!fs::is_regular_file(source)) return false;
  std::string ending = source.extension().string();
  for (char& c : ending) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  static const std::set<std::string> kOthers{".json", ".obj", ".ply", ".stl", ".off", ".gltf", ".glb"};
  return !kOthers.contains(ending);
}

ExportResult export_heights(const fs::path& source, HeightFile format, const ReadHeightsConfig& reading,
                            const Observer& observer) {
  const std::string ending = format == HeightFile::kX3p ? ".x3p" : format == HeightFile::kGsf ? ".gsf" : ".sdf";
  ExportResult out;
  if (holds_heights_alone(source)) {
    out.files.push_back({source.stem().string() + ending, bytes_of(read_map(source, reading, out.problems), format)});
    for (Problem& problem : out.problems) problem.kind = "warning";
    return out;
  }
  if (const fs::path profile = source / "profile.csv"; fs::is_directory(source) && fs::exists(profile))
    out.files.push_back(
        {"profile" + ending, bytes_of(read_map(profile, {.column = "height_m"}, out.problems), format)});
  if (fs::is_directory(source) && !fs::exists(source / "scene.json")) return out;
  std::set<std::string> used;
  for (const SceneObject& object : read_export_source(source, observer).objects) {
    for (const SceneTexture& texture : object.textures) {
      const auto* areal = std::get_if<ArealTexture>(&texture.texture.model);
      if (areal == nullptr) continue;
      std::string stem = fs::path(texture.file).stem().stem().string();
      for (int i = 2; !used.insert(stem).second; ++i)
        stem = fs::path(texture.file).stem().stem().string() + "-" + std::to_string(i);
      ArealMap map = map_of(*areal);
      if (map.columns < 2 || map.rows < 2) continue;
      out.files.push_back({stem + ".map" + ending, bytes_of(map, format)});
    }
  }
  return out;
}

}  // namespace asperity
