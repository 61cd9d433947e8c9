#include "asperity/scene/write_scene.h"

#include <set>
#include <utility>

#include "asperity/base/csv.h"
#include "asperity/base/error.h"
#include "asperity/base/output.h"
#include "asperity/base/text.h"
#include "asperity/geometry/write_mtl.h"
#include "asperity/geometry/write_obj.h"
#include "asperity/scene/covered_triangles.h"
#include "asperity/scene/read_scene.h"
#include "asperity/texture/texture_file.h"
#include "scene_json.h"
#include "texture_origin_json.h"

namespace asperity {

namespace fs = std::filesystem;

namespace {

bool is_identity(const Pose& pose) {
  return pose.translation_m.isZero(0.0) && pose.rotation.coeffs() == Eigen::Quaterniond::Identity().coeffs();
}

// `wanted`, or with the first number before it that makes a name which is not taken; then it is.
std::string take_name(const std::string& wanted, std::set<std::string>& taken) {
  const fs::path path(wanted);
  std::string name = wanted;
  for (int n = 2; taken.count(name) > 0; ++n)
    name = (path.parent_path() / (std::to_string(n) + "-" + path.filename().string())).string();
  taken.insert(name);
  return name;
}

// The files of what is covered, one an object: two objects may have called theirs the same.
std::vector<std::string> covered_files(const Scene& scene) {
  std::set<std::string> taken;
  for (const SceneObject& object : scene.objects) {
    taken.insert({object.mesh_file, object.material_file});
    for (const SceneTexture& texture : object.textures) taken.insert(texture.file);
  }
  std::vector<std::string> out;
  for (const SceneObject& object : scene.objects)
    out.push_back(object.covered_file.empty() ? std::string() : take_name(object.covered_file, taken));
  return out;
}

void add_object(Json& out, const SceneObject& object, const std::string& covered_file) {
  out["mesh"] = object.mesh_file;
  out["unit_m"] = object.unit_m;
  out["textures"] = Json::array();
  for (const SceneTexture& texture : object.textures) {
    Json entry{{"index", texture.index}, {"file", texture.file}};
    if (texture.order != 0) entry["order"] = texture.order;
    if (texture.origin) entry["source"] = format_texture_origin(*texture.origin);
    out["textures"].push_back(std::move(entry));
  }
  if (!covered_file.empty()) out["covered"] = covered_file;
  if (!object.material_file.empty()) out["material"] = object.material_file;
  if (!is_identity(object.T_world_mesh)) out["T_world_mesh"] = format_pose(object.T_world_mesh);
}

// The files of a scene, each name once and inside the scene's folder.
class Files {
 public:
  void add(std::vector<SceneFile> files) {
    for (SceneFile& file : files) add(file.name, std::move(file.content));
  }
  void add(const std::string& name, std::string content) {
    if (!stays_inside(name)) throw Error("scene: '" + printable(name) + "' is not a file in the scene's folder");
    if (!names_.insert(name).second) throw Error("scene: two files would be called '" + printable(name) + "'");
    files_.push_back({name, std::move(content)});
  }
  std::vector<SceneFile> take() { return std::move(files_); }

 private:
  std::set<std::string> names_;
  std::vector<SceneFile> files_;
};

}  // namespace

std::string format_scene(const Scene& scene) {
  if (scene.objects.empty()) throw Error("scene: no object");
  Json out;
  out["format"] = "asperity-scene";
  out["version"] = 1;
  const std::vector<std::string> covered = covered_files(scene);
  add_object(out, scene.objects.front(), covered.front());
  if (scene.stiffness_N_per_m) out["stiffness_N_per_m"] = *scene.stiffness_N_per_m;
  if (scene.friction) out["friction"] = *scene.friction;
  if (scene.static_friction_ratio) out["static_friction_ratio"] = *scene.static_friction_ratio;
  if (scene.T_mesh_world) out["T_mesh_world"] = format_pose(*scene.T_mesh_world);
  for (std::size_t i = 1; i < scene.objects.size(); ++i) {
    Json object;
    add_object(object, scene.objects[i], covered[i]);
    out["objects"].push_back(object);
  }
  if (!scene.extra.is_object()) throw Error("scene: extra is not an object: " + shown(scene.extra));
  if (!scene.extra.empty()) out["extra"] = scene.extra;
  return out.dump(2) + "\n";
}

std::vector<SceneFile> format_texture_in_scene(const SceneTexture& texture) {
  const fs::path folder = fs::path(texture.file).parent_path();
  TextureFiles files = format_texture_files(texture.texture, texture_stem(texture.file));
  std::vector<SceneFile> out;
  for (TexturePayload& payload : files.payloads)
    out.push_back({(folder / payload.file).string(), std::move(payload.content)});
  out.push_back({texture.file, std::move(files.json)});
  return out;
}

std::vector<SceneFile> format_mesh_in_scene(const std::string& name, const MeshFile& mesh) {
  if (mesh.materials.empty()) return {{name, format_obj(mesh)}};
  MeshFile named = mesh;
  const fs::path library = fs::path(name).replace_extension(".mtl");
  named.material_libraries = {library.filename().string()};
  return {{library.string(), format_mtl(mesh.materials)}, {name, format_obj(named)}};
}

void name_meshes_obj(Scene& scene) {
  std::set<std::string> taken;
  for (const SceneObject& object : scene.objects) {
    taken.insert({object.covered_file, object.material_file});
    for (const SceneTexture& texture : object.textures) taken.insert(texture.file);
  }
  // Those whose name is right already keep it.
  for (const bool is_obj : {true, false}) {
    for (SceneObject& object : scene.objects) {
      const fs::path file(object.mesh_file);
      if ((file.extension() == ".obj") != is_obj || (is_obj && taken.insert(object.mesh_file).second)) continue;
      object.mesh_file = take_name(fs::path(file).replace_extension(".obj").string(), taken);
    }
  }
}

std::vector<SceneFile> format_scene_files(const std::string& name, const Scene& scene) {
  Files out;
  std::string text = format_scene(scene);
  const std::vector<std::string> covered = covered_files(scene);
  for (std::size_t i = 0; i < scene.objects.size(); ++i) {
    const SceneObject& object = scene.objects[i];
    for (const SceneTexture& texture : object.textures) out.add(format_texture_in_scene(texture));
    if (!covered[i].empty()) out.add(covered[i], format_covered_triangles(object.covered));
    if (!object.material_file.empty()) out.add(object.material_file, format_material_map(object.material));
    if (fs::path(object.mesh_file).extension() != ".obj")
      throw Error("scene: the mesh '" + printable(object.mesh_file) + "' is not called *.obj");
    out.add(format_mesh_in_scene(object.mesh_file, object.mesh));
  }
  out.add(name, std::move(text));
  return out.take();
}

void write_scene(const fs::path& path, const Scene& scene) {
  const fs::path folder = path.parent_path();
  for (const SceneFile& file : format_scene_files(path.filename().string(), scene)) {
    fs::create_directories((folder / file.name).parent_path());
    write_file(folder / file.name, file.content);
  }
}

std::optional<std::string> find_other_content(const fs::path& folder, const std::vector<SceneFile>& files) {
  for (const SceneFile& file : files) {
    const fs::path there = folder / file.name;
    std::error_code error;
    if (!fs::exists(fs::symlink_status(there, error))) continue;
    const bool same = fs::is_regular_file(there, error) && fs::file_size(there, error) == file.content.size() &&
                      read_file(there, file.content.size()) == file.content;
    if (!same) return file.name;
  }
  return std::nullopt;
}

}  // namespace asperity
