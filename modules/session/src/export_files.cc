#include "asperity/session/export_files.h"

#include <set>
#include <string>
#include <string_view>
#include <utility>

#include "asperity/base/csv.h"
#include "asperity/base/error.h"
#include "asperity/base/output.h"
#include "asperity/base/text.h"
#include "asperity/base/version.h"
#include "asperity/json/json.h"
#include "asperity/scene/read_scene.h"
#include "asperity/session/our_folder.h"
#include "asperity/texture/texture_file.h"
#include "source_warnings.h"

namespace asperity {

namespace fs = std::filesystem;
namespace {

constexpr std::uint64_t kLargestImage_bytes = std::uint64_t{256} << 20;

// The folder of the files that a source consists of.
fs::path folder_of(const fs::path& source) { return fs::is_directory(source) ? source : source.parent_path(); }

Scene read_source(const fs::path& path, const Observer& observer) {
  const auto texture_alone = [&observer](const fs::path& file) {
    Scene scene;
    SceneObject object;
    object.textures.push_back({1, file.filename().string(), read_texture(file, {}, observer)});
    scene.objects.push_back(std::move(object));
    return scene;
  };
  if (fs::is_directory(path)) {
    if (fs::exists(path / "scene.json")) return read_scene(path / "scene.json", observer);
    if (fs::exists(path / "texture.json")) return texture_alone(path / "texture.json");
    throw Error(printable(path.string(), 200) + ": holds neither scene.json nor texture.json" +
                (fs::exists(path / "profile.csv")
                     ? ", only profile.csv. It can be exported to x3p, sdf, sdf-binary, gsf"
                     : "; name the folder of a result or of a scene"));
  }
  const std::string name = path.filename().string();
  if (name == "texture.json" || name.ends_with(".texture.json")) return texture_alone(path);
  return read_scene(path, observer);
}

Json messages_of(const Problems& problems, std::string_view kind) {
  Json out = Json::array();
  for (const Problem& problem : problems)
    if (problem.kind == kind) out.push_back(problem.message);
  return out;
}

}  // namespace

Scene read_export_source(const fs::path& path, const Observer& observer) {
  Scene scene = read_source(path, observer);
  add_source_warnings(folder_of(path), scene);
  return scene;
}

void add_material_images(const fs::path& source, const Scene& scene, ExportFormat format, ExportResult& result) {
  if (format != ExportFormat::kObj && format != ExportFormat::kGltf && format != ExportFormat::kUsda) return;
  std::set<std::string> names;
  for (const ExportedFile& file : result.files) names.insert(file.name);
  for (const SceneObject& object : scene.objects) {
    const fs::path folder = (folder_of(source) / object.mesh_file).parent_path();
    for (const MeshMaterial& material : object.mesh.materials) {
      for (const std::string* image :
           {&material.base_colour_map, &material.normal_map, &material.bump_map, &material.displacement_map}) {
        if (image->empty()) continue;
        if (!names.insert(*image).second) continue;
        try {
          result.files.push_back({*image, read_file(folder / *image, kLargestImage_bytes)});
        } catch (const Error& error) {
          result.problems.push_back({"not_exported", "an image of a material: " + std::string(error.what()), 1});
        }
      }
    }
  }
}

Json write_export(const fs::path& folder, const ExportResult& result) {
  Json out;
  out["files"] = Json::array();
  for (const ExportedFile& file : result.files) {
    if (const fs::path below = fs::path(file.name).parent_path(); !below.empty())
      fs::create_directories(folder / below);
    write_file(folder / file.name, file.content);
    out["files"].push_back({{"name", file.name}, {"bytes", file.content.size()}});
  }
  out["problems"] = Json::array();
  for (const Problem& problem : result.problems) {
    out["problems"].push_back({{"kind", problem.kind}, {"message", problem.message}, {"count", problem.count}});
  }
  Json about;
  about["format"] = "asperity-exported";
  about["version"] = 1;
  about["asperity"] = kVersion;
  about["files"] = out["files"];
  about["warnings"] = messages_of(result.problems, "warning");
  about["not_exported"] = messages_of(result.problems, "not_exported");
  write_file(folder / "export.json", about.dump_repaired(2) + "\n");
  write_listing(folder);
  return out;
}

}  // namespace asperity
