#include "asperity/scene/read_scene.h"

#include <map>
#include <string>
#include <utility>

#include "asperity/base/csv.h"
#include "asperity/base/error.h"
#include "asperity/base/inner_path.h"
#include "asperity/base/text.h"
#include "asperity/geometry/read_mesh.h"
#include "asperity/scene/covered_triangles.h"
#include "asperity/texture/texture_file.h"
#include "asperity/texture/texture_operations.h"
#include "parse_scene.h"

namespace asperity {

namespace fs = std::filesystem;

namespace {

constexpr std::uint64_t kLargestScene_bytes = 16 << 20;
constexpr std::uint64_t kLargestMap_bytes = 1 << 30;

// The files that a scene names: each inside its folder, all together of a bounded size.
class NamedFiles {
 public:
  NamedFiles(fs::path scene, std::uint64_t limit_bytes)
      : scene_(std::move(scene)), folder_(scene_.parent_path()), limit_bytes_(limit_bytes) {}

  fs::path find(const std::string& name) {
    if (!inner_file(folder_, name)) {
      throw Error(printable(scene_.string()) + ": names '" + printable(name) +
                  "', a link that leads out of the scene's folder");
    }
    std::error_code error;
    fs::path file = folder_ / name;
    if (const std::uintmax_t size = fs::file_size(file, error); !error) count(size);
    return file;
  }
  void count(std::uint64_t bytes) {
    bytes_ += bytes;
    if (bytes_ > limit_bytes_) {
      throw Error(printable(scene_.string()) + ": its files take more than " + std::to_string(limit_bytes_) + " bytes");
    }
  }

 private:
  fs::path scene_, folder_;
  std::uint64_t limit_bytes_;
  std::uint64_t bytes_ = 0;
};

// What the mesh file says of itself, and the textures that only it knows.
void append_object_problems(const SceneObject& object, Problems& problems) {
  problems.insert(problems.end(), object.mesh.problems.begin(), object.mesh.problems.end());
  std::map<int, std::size_t> unlisted;
  for (const HapticTriangle& triangle : object.mesh.haptic) {
    if (triangle.texture >= 0 && object.find_texture(triangle.texture) == nullptr) ++unlisted[triangle.texture];
  }
  for (const auto& [index, triangles] : unlisted) {
    problems.push_back({"unlisted_texture",
                        printable(object.mesh_file) + ": triangles with texture " + std::to_string(index) +
                            ", which the scene does not list, are rendered without texture",
                        triangles});
  }
}

void read_object(NamedFiles& files, SceneObject& object, Problems& problems, const Observer& observer) {
  observer.update("read", 0.0);
  object.mesh = read_mesh(files.find(object.mesh_file), {}, observer);
  for (SceneTexture& texture : object.textures) {
    observer.update("read", 0.0);
    texture.texture = read_texture(files.find(texture.file), {}, observer);
    files.count(size_bytes(texture.texture));
  }
  if (!object.covered_file.empty()) {
    const fs::path file = files.find(object.covered_file);
    object.covered = parse_covered_triangles(read_file(file, kLargestMap_bytes), printable(file.string()),
                                             object.mesh.triangles.size());
  }
  if (!object.material_file.empty()) {
    const fs::path file = files.find(object.material_file);
    object.material =
        parse_material_map(read_file(file, kLargestMap_bytes), printable(file.string()), object.mesh.vertices.size());
  }
  append_object_problems(object, problems);
}

}  // namespace

bool stays_inside(const fs::path& name) {
  if (name.empty() || name.has_root_path() || !name.has_filename()) return false;
  for (const fs::path& part : name) {
    if (part == ".." || part == ".") return false;
  }
  return name.native().find_first_of(std::string_view("\0\\", 2)) == fs::path::string_type::npos;
}

Scene read_scene(const fs::path& path, const Observer& observer, std::uint64_t limit_bytes) {
  const Observer asked = observer.without_progress();
  Scene scene;
  if (path.extension() != ".json") {
    SceneObject object;
    object.mesh_file = path.filename().string();
    object.mesh = read_mesh(path, {}, asked);
    append_object_problems(object, scene.problems);
    scene.objects.push_back(std::move(object));
    return scene;
  }
  scene = parse_scene(read_file(path, kLargestScene_bytes), printable(path.string()), asked);
  NamedFiles files(path, limit_bytes);
  for (SceneObject& object : scene.objects) read_object(files, object, scene.problems, asked);
  return scene;
}

}  // namespace asperity
