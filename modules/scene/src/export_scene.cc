#include "asperity/scene/export_scene.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>
#include <string>
#include <utility>

#include "asperity/base/error.h"
#include "asperity/base/rounded_text.h"
#include "asperity/base/text.h"
#include "asperity/base/version.h"
#include "asperity/geometry/write_stl.h"
#include "asperity/json/json.h"
#include "asperity/scene/format_x3p.h"
#include "asperity/texture/evaluate_height.h"
#include "asperity/texture/sample_heights.h"
#include "export_parts.h"
#include "part_observer.h"

namespace asperity {

std::string texture_title(const SceneTexture& texture) {
  return texture.texture.name.empty() ? texture.file : texture.texture.name;
}

std::optional<double> stiffness_of(const Scene& scene, const Texture& texture) {
  return texture.stiffness_N_per_m ? texture.stiffness_N_per_m : scene.stiffness_N_per_m;
}

std::optional<double> friction_of(const Scene& scene, const Texture& texture) {
  return texture.friction ? texture.friction : scene.friction;
}

std::string stem_of(const std::string& file, std::set<std::string>& used) {
  std::string stem = std::filesystem::path(file).filename().string();
  const std::string ending = ".texture.json";
  if (stem.size() > ending.size() && stem.ends_with(ending)) {
    stem.resize(stem.size() - ending.size());
  } else {
    stem = std::filesystem::path(stem).stem().string();
  }
  if (stem.empty()) stem = "unnamed";
  std::string name = stem;
  for (int i = 2; !used.insert(name).second; ++i) name = stem + "-" + std::to_string(i);
  return name;
}

namespace {

std::string json_text(const Json& json) { return json.dump_repaired(2) + "\n"; }

double height_of(const HeightMap& map, std::size_t i) { return map.low_m + map.level[i] * map.metres_per_level(); }

}  // namespace

TextureMaps add_images(const std::string& stem, const SceneTexture& texture, const ExportConfig& config,
                       const Observer& observer, ExportResult& out) {
  TextureMaps maps = make_texture_maps(texture.texture, config.images, observer);
  Json about{{"format", "asperity-images"},
             {"version", 1},
             {"height_map", stem + ".height.png"},
             {"normal_map", stem + ".normal.png"},
             {"mm_per_px_x", maps.heights.mm_per_px_x},
             {"mm_per_px_y", maps.heights.mm_per_px_y},
             {"black_m", maps.heights.low_m},
             {"white_m", maps.heights.high_m}};
  if (!texture.warning.empty()) about["warning"] = texture.warning;
  if (const auto* areal = std::get_if<ArealTexture>(&texture.texture.model);
      areal != nullptr && !areal->sigma_m.empty()) {
    double white_m = 0.0;
    for (std::size_t i = 0; i < areal->sigma_m.size(); ++i)
      if (areal->supported[i] != 0) white_m = std::max(white_m, areal->sigma_m[i]);
    white_m = white_m > 0.0 ? white_m : 1e-6;
    about["sigma_map"] = stem + ".sigma.png";
    about["sigma_white_m"] = white_m;
    out.files.push_back({stem + ".sigma.png", format_sigma_png(*areal, maps.heights, white_m)});
  }
  out.files.push_back({stem + ".height.png", std::move(maps.height_png)});
  out.files.push_back({stem + ".normal.png", std::move(maps.normal_png)});
  out.files.push_back({stem + ".images.json", json_text(about)});
  return maps;
}

namespace {

std::string mm_text(double x_m) { return rounded_text(1e3 * x_m, 5); }

// What of the heights of an X3P file of that extent was measured, and what a model made of it.
std::string measured_note(const TextureModel& model, double length_m, double width_m) {
  const std::string begin = std::string("asperity ") + kVersion + ": ";
  if (const auto* areal = std::get_if<ArealTexture>(&model)) {
    const SplineGrid& g = areal->surface;
    const double x_m = g.origin_x_m + 2.0 * g.spacing_x_m, y_m = g.origin_y_m + 2.0 * g.spacing_y_m;
    const double to_x_m = x_m + (static_cast<double>(g.columns) - 5.0) * g.spacing_x_m;
    const double to_y_m = y_m + (static_cast<double>(g.rows) - 5.0) * g.spacing_y_m;
    std::string out = begin + "an areal surface fitted with points " + mm_text(g.spacing_x_m) +
                      " mm apart. Measured: x " + mm_text(x_m) + " to " + mm_text(to_x_m) + " mm, y " + mm_text(y_m) +
                      " to " + mm_text(to_y_m) + " mm from the first point of this file. ";
    std::size_t gaps = 0;
    for (std::size_t r = 2; r + 2 < g.rows; ++r)
      for (std::size_t c = 2; c + 2 < g.columns; ++c) gaps += areal->supported[r * g.columns + c] == 0 ? 1 : 0;
    if (gaps > 0) out += std::to_string(gaps) + " of its points have no height near and were filled smoothly. ";
    const bool beyond = length_m > to_x_m + g.spacing_x_m || width_m > to_y_m + g.spacing_y_m;
    return out + (beyond ? "The surface beyond was continued (border: " +
                               std::string(kBorderNames.at(static_cast<std::size_t>(g.border))) + "), not measured."
                         : "The file ends there.");
  }
  if (const auto* surface = std::get_if<Fourier2d>(&model)) {
    if (surface->kind == Fourier2dKind::kIsotropic)
      return begin + "a surface synthesised with the spectrum of a measured profile and random phases (seed " +
             std::to_string(surface->isotropic.seed) + "). No height was measured where it is.";
    return begin + "a surface made of the product of profiles along x and y. Only lines along x and y were measured.";
  }
  if (width_m == 0.0) return begin + "a profile by the model " + std::string(kTextureModelNames[model.index()]) + ".";
  return begin + "a surface by the model " + std::string(kTextureModelNames[model.index()]) +
         ". The file does not say which part of it was measured.";
}

void add_x3p(const std::string& stem, const SceneTexture& from, const ExportConfig& config, const Observer& observer,
             ExportResult& out) {
  const Texture& texture = from.texture;
  X3pGrid grid;
  if (const auto length_mm = line_length_mm(texture.model)) {
    SampleHeightsConfig line;
    line.length_mm = *length_mm;
    line.spacing_mm = std::min(line.spacing_mm, *length_mm / 256.0);
    grid.height_m = sample_heights(texture.model, line);
    grid.columns = grid.height_m.size();
    grid.x_spacing_m = 1e-3 * line.spacing_mm;
  } else {
    const TextureMaps maps = make_texture_maps(texture, config.images, observer);
    grid.columns = maps.heights.columns;
    grid.rows = maps.heights.rows;
    grid.x_spacing_m = 1e-3 * maps.heights.mm_per_px_x;
    grid.y_spacing_m = 1e-3 * maps.heights.mm_per_px_y;
    for (std::size_t i = 0; i < maps.heights.level.size(); ++i) grid.height_m.push_back(height_of(maps.heights, i));
  }
  const double width_m = grid.rows > 1 ? grid.y_spacing_m * static_cast<double>(grid.rows) : 0.0;
  grid.note = measured_note(texture.model, grid.x_spacing_m * static_cast<double>(grid.columns), width_m);
  if (!from.warning.empty()) grid.note += " WARNING: " + printable(from.warning, 1000);
  out.files.push_back({stem + ".x3p", format_x3p(grid)});
}

void add_texture(const std::string& stem, const Scene& scene, const SceneTexture& texture, ExportFormat format,
                 const ExportConfig& config, const Observer& observer, ExportResult& out) {
  if (format == ExportFormat::kWav || format == ExportFormat::kAhap || format == ExportFormat::kHaps) {
    add_vibration(stem, texture, format, config, out);
  } else if (format == ExportFormat::kHjif || format == ExportFormat::kHmpg) {
    add_haptics(stem, scene, texture, format, config, out);
  } else if (!is_height_field(texture.texture.model)) {
    out.problems.push_back({"not_exported", printable(stem) + ": a force in time has no heights", 1});
  } else if (format == ExportFormat::kPng) {
    add_images(stem, texture, config, observer, out);
  } else {
    add_x3p(stem, texture, config, observer, out);
  }
}

void add_relief(const std::string& stem, const SceneObject& object, const ExportConfig& config, ExportResult& out) {
  MeshFile relief = displace_mesh(object, config.relief);
  for (Eigen::Vector3d& vertex : relief.vertices) vertex *= 1e3 * object.unit_m;
  out.files.push_back({stem + ".stl", format_stl(relief)});
  out.problems.push_back({"not_exported", printable(stem) + ": stiffness, friction and colours; STL has a shape", 1});
}

bool is_mesh_format(ExportFormat format) {
  return format == ExportFormat::kObj || format == ExportFormat::kGltf || format == ExportFormat::kUsda ||
         format == ExportFormat::kStl;
}

}  // namespace

ExportResult export_scene(const Scene& scene, ExportFormat format, const ExportConfig& config,
                          const Observer& observer) {
  ExportResult out;
  std::set<std::string> used;
  std::size_t count = 0;
  for (const SceneObject& object : scene.objects) count += object.textures.size();
  std::size_t begun = 0;
  const auto next = [&](std::size_t textures) {
    const double whole = std::max(1.0, static_cast<double>(count));
    const double from = static_cast<double>(begun) / whole;
    begun += textures;
    observer.update("exporting", from);
    return part_observer(observer, "exporting", from, static_cast<double>(begun) / whole);
  };
  for (const SceneObject& object : scene.objects) {
    for (const SceneTexture& texture : object.textures) {
      if (!texture.warning.empty())
        out.problems.push_back({"warning", printable(texture.file) + ": " + printable(texture.warning, 1000), 1});
    }
    if (!is_mesh_format(format)) {
      for (const SceneTexture& texture : object.textures)
        add_texture(stem_of(texture.file, used), scene, texture, format, config, next(1), out);
    } else if (!object.mesh.triangles.empty()) {
      const std::string stem = stem_of(object.mesh_file, used);
      const Observer of_object = next(object.textures.size());
      if (format == ExportFormat::kStl) {
        add_relief(stem, object, config, out);
      } else {
        add_mesh_object(stem, scene, object, format, config, of_object, used, out);
      }
    }
  }
  if (out.files.empty()) {
    throw Error("export: the scene holds nothing that can be written as " +
                std::string(kExportFormatNames[static_cast<std::size_t>(format)]));
  }
  return out;
}

}  // namespace asperity
