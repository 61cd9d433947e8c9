#include "asperity/session/export_files.h"

#include <string>

#include "asperity/base/error.h"
#include "asperity/base/output.h"
#include "asperity/base/text.h"
#include "asperity/json/json.h"
#include "asperity/scene/read_scene.h"
#include "asperity/session/our_folder.h"
#include "asperity/texture/texture_file.h"

namespace asperity {

namespace fs = std::filesystem;
Scene read_export_source(const fs::path& path, const Observer& observer) {
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
    throw Error(printable(path.string(), 200) + ": holds neither scene.json nor texture.json");
  }
  const std::string name = path.filename().string();
  if (name == "texture.json" || name.ends_with(".texture.json")) return texture_alone(path);
  return read_scene(path, observer);
}

Json write_export(const fs::path& folder, const ExportResult& result) {
  Json out;
  out["files"] = Json::array();
  for (const ExportedFile& file : result.files) {
    write_file(folder / file.name, file.content);
    out["files"].push_back({{"name", file.name}, {"bytes", file.content.size()}});
  }
  out["problems"] = Json::array();
  for (const Problem& problem : result.problems) {
    out["problems"].push_back({{"kind", problem.kind}, {"message", problem.message}, {"count", problem.count}});
  }
  write_listing(folder);
  return out;
}

}  // namespace asperity
