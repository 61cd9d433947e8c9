#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "asperity/base/text.h"
#include "asperity/geometry/write_gltf.h"
#include "asperity/image/png_image.h"
#include "asperity/scene/format_usda.h"
#include "asperity/scene/write_scene.h"
#include "asperity/texture/evaluate_height.h"
#include "export_parts.h"
#include "mesh_groups.h"
#include "part_observer.h"

namespace asperity {

namespace {

// The images of an object's textures, written beside it, by the texture's index.
struct Images {
  std::string stem;
  TextureMaps maps;
};

// Of each texture of an object its part of the whole.
class TextureSteps {
 public:
  TextureSteps(const SceneObject& object, const Observer& observer)
      : step_(1.0 / std::max(1.0, static_cast<double>(object.textures.size()))), observer_(observer) {}
  Observer next() {
    const double from = step_ * begun_;
    begun_ += 1.0;
    return part_observer(observer_, "exporting", from, from + step_);
  }

 private:
  double step_;
  double begun_ = 0.0;
  const Observer& observer_;
};

std::map<int, Images> write_images(const SceneObject& object, const ExportConfig& config, const Observer& observer,
                                   std::set<std::string>& used, ExportResult& out) {
  std::map<int, Images> images;
  TextureSteps steps(object, observer);
  for (const SceneTexture& texture : object.textures) {
    const Observer of_texture = steps.next();
    if (!is_height_field(texture.texture.model)) {
      out.problems.push_back({"not_exported", printable(texture.file) + ": a force in time has no image", 1});
      continue;
    }
    const std::string stem = stem_of(texture.file, used);
    images[texture.index] = {stem, add_images(stem, texture, config, of_texture, out)};
  }
  return images;
}

void name_what_is_lost(const std::string& stem, const Scene& scene, const SceneObject& object, ExportFormat format,
                       ExportResult& out) {
  const auto lost = [&](const std::string& what) {
    out.problems.push_back({"not_exported", printable(stem) + ": " + what, 1});
  };
  if (!object.material.vertices.empty())
    lost("the material map: stiffness and friction are those of the textures or the scene, not of the positions");
  if (!object.covered.empty()) lost("textures below others");
  bool sticks = scene.static_friction_ratio.has_value();
  bool yields = false;
  for (const SceneTexture& texture : object.textures) {
    sticks = sticks || texture.texture.static_friction_ratio.has_value();
    yields = yields || texture.texture.compliance_kc.has_value();
  }
  if (sticks && format != ExportFormat::kUsda) lost("the coefficient of sticking");
  if (yields) lost("the compliance k_c");
  if (format != ExportFormat::kObj && object.mesh.parts.size() > 1)
    lost("names of objects and groups, smoothing groups");
}

// The same mesh with a material for each texture with each material, and one for what has neither; without texture
// coordinates of its own, those of the haptic textures, v upwards.
MeshFile with_texture_materials(const SceneObject& object, const std::map<int, Images>& images) {
  MeshFile out = object.mesh;
  const bool own = !out.texture_corners.empty();
  std::vector<std::int32_t> material(out.triangles.size(), -1);
  for (const auto& [key, triangles] : mesh_groups(object.mesh)) {
    std::int32_t index = key.second;
    const auto image = images.find(key.first);
    if (image != images.end() && !own) {
      MeshMaterial mixed = index >= 0 ? out.materials[static_cast<std::size_t>(index)] : MeshMaterial{};
      mixed.name += (mixed.name.empty() ? "" : "-") + image->second.stem;
      mixed.normal_map = image->second.stem + ".normal.png";
      mixed.displacement_map = image->second.stem + ".height.png";
      index = static_cast<std::int32_t>(out.materials.size());
      out.materials.push_back(std::move(mixed));
    } else if (index < 0 && !images.empty() && !own) {
      // An OBJ cannot end a material but by another.
      index = static_cast<std::int32_t>(out.materials.size());
      out.materials.emplace_back().name = "untextured";
    }
    for (const std::uint32_t t : triangles) material[t] = index;
  }
  out.parts.clear();
  auto part = object.mesh.parts.begin();
  MeshPart current;
  for (std::uint32_t t = 0; t < out.triangles.size(); ++t) {
    for (; part != object.mesh.parts.end() && part->first_triangle <= t; ++part) current = *part;
    current.first_triangle = t;
    current.material = material[t];
    MeshPart last = out.parts.empty() ? MeshPart{} : out.parts.back();
    last.first_triangle = t;
    if (out.parts.empty() || !(last == current)) out.parts.push_back(current);
  }
  if (own || images.empty()) return out;
  out.texture_corners.assign(out.triangles.size(), {kNoIndex, kNoIndex, kNoIndex});
  std::map<std::pair<double, double>, std::uint32_t> places;
  for (std::size_t t = 0; t < out.triangles.size() && t < out.haptic.size(); ++t) {
    const auto image = images.find(out.haptic[t].texture);
    if (image == images.end()) continue;
    for (std::size_t k = 0; k < 3; ++k) {
      const Eigen::Vector2d p = out.haptic[t].xy_mm[k].cwiseQuotient(image->second.maps.size_mm);
      const auto [entry, is_new] =
          places.try_emplace({p.x(), 1.0 - p.y()}, static_cast<std::uint32_t>(out.texture_coordinates.size()));
      if (is_new) out.texture_coordinates.emplace_back(p.x(), 1.0 - p.y(), 0.0);
      out.texture_corners[t][k] = entry->second;
    }
  }
  return out;
}

void add_obj(const std::string& stem, const Scene& scene, const SceneObject& object, const ExportConfig& config,
             const Observer& observer, std::set<std::string>& used, ExportResult& out) {
  const std::map<int, Images> images = write_images(object, config, observer, used, out);
  if (!images.empty() && !object.mesh.texture_corners.empty()) {
    out.problems.push_back({"not_exported",
                            printable(stem) + ": texture maps in the MTL; the mesh has texture coordinates of its own, "
                                              "and an OBJ has one set. The haptic ones are in its h lines",
                            1});
  }
  const MeshFile mesh = with_texture_materials(object, images);
  std::string note =
      fmt::format("# asperity. Lengths of the mesh are {} m. Heights and normals repeat every width and height.\n",
                  number_text(object.unit_m));
  for (const SceneTexture& texture : object.textures) {
    note += "# texture " + std::to_string(texture.index) + ": " + printable(texture_title(texture));
    if (const auto image = images.find(texture.index); image != images.end()) {
      const TextureMaps& maps = image->second.maps;
      note += fmt::format(", {} mm x {} mm, {}.height.png black {} m, white {} m", number_text(maps.size_mm.x()),
                          number_text(maps.size_mm.y()), image->second.stem, number_text(maps.heights.low_m),
                          number_text(maps.heights.high_m));
    }
    if (const auto k = stiffness_of(scene, texture.texture)) note += ", stiffness " + number_text(*k) + " N/m";
    if (const auto mu = friction_of(scene, texture.texture)) note += ", friction " + number_text(*mu);
    if (!texture.warning.empty()) note += ", WARNING: " + printable(texture.warning, 1000);
    note += "\n";
  }
  for (SceneFile& file : format_mesh_in_scene(stem + ".obj", mesh)) {
    if (file.name.ends_with(".mtl") && !object.textures.empty()) file.content = note + file.content;
    out.files.push_back({file.name, std::move(file.content)});
  }
}

void add_usda(const std::string& stem, const Scene& scene, const SceneObject& object, const ExportConfig& config,
              const Observer& observer, std::set<std::string>& used, ExportResult& out) {
  const std::map<int, Images> images = write_images(object, config, observer, used, out);
  std::vector<UsdaTexture> textures;
  for (const SceneTexture& texture : object.textures) {
    UsdaTexture one;
    one.index = texture.index;
    one.name = texture_title(texture);
    if (const auto image = images.find(texture.index); image != images.end()) {
      one.size_mm = image->second.maps.size_mm;
      one.height_file = image->second.stem + ".height.png";
      one.normal_file = image->second.stem + ".normal.png";
      one.black_m = image->second.maps.heights.low_m;
      one.white_m = image->second.maps.heights.high_m;
    }
    one.stiffness_N_per_m = stiffness_of(scene, texture.texture);
    one.friction = friction_of(scene, texture.texture);
    one.static_friction_ratio =
        texture.texture.static_friction_ratio ? texture.texture.static_friction_ratio : scene.static_friction_ratio;
    one.warning = texture.warning;
    textures.push_back(std::move(one));
  }
  out.files.push_back({stem + ".usda", format_usda(stem, object.mesh, object.unit_m, textures)});
}

void add_gltf(const std::string& stem, const Scene& scene, const SceneObject& object, const ExportConfig& config,
              const Observer& observer, ExportResult& out) {
  GltfExport gltf;
  gltf.mesh = object.mesh;
  gltf.unit_m = object.unit_m;
  gltf.white_png = format_png(GrayImage{1, 1, {255}, 8});
  TextureSteps steps(object, observer);
  for (const SceneTexture& texture : object.textures) {
    const Observer of_texture = steps.next();
    GltfTexture one;
    one.index = texture.index;
    one.name = texture_title(texture);
    one.stiffness_N_per_m = stiffness_of(scene, texture.texture);
    one.friction = friction_of(scene, texture.texture);
    one.warning = texture.warning;
    if (is_height_field(texture.texture.model)) {
      TextureMaps maps = make_texture_maps(texture.texture, config.images, of_texture);
      one.size_mm = maps.size_mm;
      one.height_low_m = maps.heights.low_m;
      one.height_range_m = maps.heights.high_m - maps.heights.low_m;
      one.normal_map = GltfImage{one.name + " normals", std::move(maps.normal_png), {}};
      one.height_map = GltfImage{one.name + " heights", std::move(maps.height_png), {}};
    } else {
      out.problems.push_back({"not_exported", printable(texture.file) + ": a force in time has no image", 1});
    }
    gltf.textures.push_back(std::move(one));
  }
  out.files.push_back({stem + ".glb", format_gltf(gltf, GltfForm::kBinary)});
}

}  // namespace

void add_mesh_object(const std::string& stem, const Scene& scene, const SceneObject& object, ExportFormat format,
                     const ExportConfig& config, const Observer& observer, std::set<std::string>& used,
                     ExportResult& out) {
  name_what_is_lost(stem, scene, object, format, out);
  if (format == ExportFormat::kObj) {
    add_obj(stem, scene, object, config, observer, used, out);
  } else if (format == ExportFormat::kUsda) {
    add_usda(stem, scene, object, config, observer, used, out);
  } else {
    add_gltf(stem, scene, object, config, observer, out);
  }
}

}  // namespace asperity
