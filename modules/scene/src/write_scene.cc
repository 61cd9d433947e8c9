#include "asperity/scene/write_scene.h"

#include <nlohmann/json.hpp>
#include <set>

#include "asperity/base/error.h"
#include "asperity/base/output.h"
#include "asperity/base/text.h"
#include "asperity/geometry/write_mtl.h"
#include "asperity/geometry/write_obj.h"
#include "asperity/scene/read_scene.h"
#include "asperity/texture/texture_file.h"

namespace asperity {

namespace fs = std::filesystem;

namespace {

using Json = nlohmann::ordered_json;

Json pose_json(const Pose& pose) {
  const Eigen::Vector3d& p = pose.translation_m;
  const Eigen::Quaterniond& q = pose.rotation;
  return {p.x(), p.y(), p.z(), q.w(), q.x(), q.y(), q.z()};
}

bool is_identity(const Pose& pose) {
  return pose.translation_m.isZero(0.0) && pose.rotation.coeffs() == Eigen::Quaterniond::Identity().coeffs();
}

void add_object(Json& out, const SceneObject& object) {
  out["mesh"] = object.mesh_file;
  out["unit_m"] = object.unit_m;
  out["textures"] = Json::array();
  for (const SceneTexture& texture : object.textures) {
    out["textures"].push_back({{"index", texture.index}, {"file", texture.file}});
  }
  if (!object.material_file.empty()) out["material"] = object.material_file;
  if (!is_identity(object.T_world_mesh)) out["T_world_mesh"] = pose_json(object.T_world_mesh);
}

// Checks the names before anything is written.
void check_names(const fs::path& path, const Scene& scene) {
  std::set<std::string> names{path.filename().string()};
  const auto claim = [&](const std::string& name) {
    if (!stays_inside(name)) throw Error("scene: '" + printable(name) + "' is not a file in the scene's folder");
    if (!names.insert(name).second) throw Error("scene: two files would be called '" + printable(name) + "'");
  };
  for (const SceneObject& object : scene.objects) {
    claim(object.mesh_file);
    if (fs::path(object.mesh_file).extension() != ".obj") {
      throw Error("scene: the mesh '" + printable(object.mesh_file) + "' is not called *.obj");
    }
    for (const SceneTexture& texture : object.textures) claim(texture.file);
    if (!object.material_file.empty()) claim(object.material_file);
  }
}

// The mesh, its materials in one library beside it.
void write_mesh(const fs::path& folder, const SceneObject& object) {
  MeshFile mesh = object.mesh;
  if (!mesh.materials.empty()) {
    const fs::path library = fs::path(object.mesh_file).replace_extension(".mtl");
    write_mtl(folder / library, mesh.materials);
    mesh.material_libraries = {library.filename().string()};
  }
  write_obj(folder / object.mesh_file, mesh);
}

}  // namespace

std::string format_scene(const Scene& scene) {
  if (scene.objects.empty()) throw Error("scene: no object");
  Json out;
  out["format"] = "asperity-scene";
  out["version"] = 1;
  add_object(out, scene.objects.front());
  if (scene.stiffness_N_per_m) out["stiffness_N_per_m"] = *scene.stiffness_N_per_m;
  if (scene.friction) out["friction"] = *scene.friction;
  if (scene.T_mesh_world) out["T_mesh_world"] = pose_json(*scene.T_mesh_world);
  for (std::size_t i = 1; i < scene.objects.size(); ++i) {
    Json object;
    add_object(object, scene.objects[i]);
    out["objects"].push_back(object);
  }
  const Json extra = Json::parse(scene.extra_json, nullptr, false);
  if (!extra.is_object()) throw Error("scene: extra_json is not a JSON object");
  if (!extra.empty()) out["extra"] = extra;
  return out.dump(2) + "\n";
}

void write_scene(const fs::path& path, const Scene& scene) {
  check_names(path, scene);
  const std::string text = format_scene(scene);
  const fs::path folder = path.parent_path();
  for (const SceneObject& object : scene.objects) {
    fs::create_directories((folder / object.mesh_file).parent_path());
    for (const SceneTexture& texture : object.textures) {
      fs::create_directories((folder / texture.file).parent_path());
      write_texture(folder / texture.file, texture.texture);
    }
    if (!object.material_file.empty()) {
      fs::create_directories((folder / object.material_file).parent_path());
      write_file(folder / object.material_file, format_material_map(object.material));
    }
    write_mesh(folder, object);
  }
  write_file(path, text);
}

}  // namespace asperity
