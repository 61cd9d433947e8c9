#include "asperity/session/write_area.h"

#include "asperity/base/output.h"
#include "asperity/scene/export_scene.h"
#include "asperity/scene/write_scene.h"
#include "asperity/session/our_folder.h"

namespace asperity {

namespace fs = std::filesystem;

namespace {

// Height, normal and σ map of the texture.
void write_pictures(const fs::path& folder, const SceneTexture& texture) {
  Scene alone;
  alone.objects.emplace_back().textures.push_back(texture);
  for (const ExportedFile& file : export_scene(alone, ExportFormat::kPng).files)
    write_file(folder / file.name, file.content);
}

}  // namespace

std::string write_area(const fs::path& folder, const AreaInput& input, const AreaResult& area) {
  Scene scene = input.scene;
  std::string name;
  if (area.texture) {
    const SceneTexture& texture = add_area(scene, area);
    name = texture.file;
    write_pictures(folder, texture);
  }
  name_meshes_obj(scene);
  write_scene(folder / "scene.json", scene);
  AreaResult noted = area;
  for (const LeftOutScan& scan : input.left_out)
    noted.problems.push_back({"scan_left_out", scan.name + ": " + scan.reason, 1});
  std::string json = format_area(noted, input.scans, name);
  write_file(folder / "area.json", json);
  write_listing(folder);
  return json;
}

}  // namespace asperity
