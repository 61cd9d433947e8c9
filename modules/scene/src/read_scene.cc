#include "asperity/scene/read_scene.h"

#include <map>
#include <string>

#include "asperity/base/csv.h"
#include "asperity/base/error.h"
#include "asperity/base/text.h"
#include "asperity/geometry/read_mesh.h"
#include "asperity/texture/texture_file.h"
#include "parse_scene.h"

namespace asperity {

namespace fs = std::filesystem;

namespace {

constexpr std::uint64_t kLargestScene_bytes = 16 << 20;
constexpr std::uint64_t kLargestMap_bytes = 1 << 30;

void read_object(const fs::path& folder, SceneObject& object, Problems& problems) {
  object.mesh = read_mesh(folder / object.mesh_file);
  problems.insert(problems.end(), object.mesh.problems.begin(), object.mesh.problems.end());
  for (SceneTexture& texture : object.textures) texture.texture = read_texture(folder / texture.file);
  if (!object.material_file.empty()) {
    const fs::path file = folder / object.material_file;
    object.material =
        parse_material_map(read_file(file, kLargestMap_bytes), printable(file.string()), object.mesh.vertices.size());
  }
  std::map<int, std::size_t> unlisted;
  for (const HapticTriangle& triangle : object.mesh.haptic) {
    if (triangle.texture >= 0 && object.find_texture(triangle.texture) == nullptr) ++unlisted[triangle.texture];
  }
  for (const auto& [index, triangles] : unlisted) {
    problems.push_back({"unlisted_texture",
                        printable(object.mesh_file) + ": triangles with texture " + std::to_string(index) +
                            ", which the scene does not list, are felt without",
                        triangles});
  }
}

}  // namespace

bool stays_inside(const fs::path& name) {
  if (name.empty() || name.has_root_path() || !name.has_filename()) return false;
  for (const fs::path& part : name) {
    if (part == ".." || part == ".") return false;
  }
  return name.native().find('\0') == fs::path::string_type::npos;
}

Scene read_scene(const fs::path& path) {
  Scene scene;
  if (path.extension() == ".json") {
    scene = parse_scene(read_file(path, kLargestScene_bytes), printable(path.string()));
  } else {
    SceneObject object;
    object.mesh_file = path.filename().string();
    scene.objects.push_back(std::move(object));
  }
  for (SceneObject& object : scene.objects) read_object(path.parent_path(), object, scene.problems);
  return scene;
}

}  // namespace asperity
