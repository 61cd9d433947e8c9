#include "asperity/session/paint_scene.h"

#include <fmt/format.h>

#include <algorithm>

#include "asperity/base/text.h"
#include "asperity/json/json.h"
#include "asperity/scene/read_scene.h"
#include "asperity/session/mesh_unit.h"
#include "asperity/texture/texture_file.h"

namespace asperity {

namespace {

namespace fs = std::filesystem;
int next_index(const SceneObject& object) {
  int index = 0;
  for (const SceneTexture& texture : object.textures) index = std::max(index, texture.index);
  for (const HapticTriangle& triangle : object.mesh.haptic) index = std::max(index, triangle.texture);
  return index + 1;
}

// Two textures of one scene share no file, nor the images named after them; none is called as another file is.
bool is_taken(const Scene& scene, int index, const std::string& name) {
  if (name == "scene.json" || name == "paint.json" || name == "files.json") return true;
  for (const SceneObject& object : scene.objects) {
    if (name == object.mesh_file || name == object.material_file) return true;
    for (const SceneTexture& other : object.textures) {
      const bool replaced = &object == &scene.objects.front() && other.index == index;
      if (!replaced && texture_stem(other.file) == texture_stem(name)) return true;
    }
  }
  return false;
}

}  // namespace

Scene read_painted_scene(const fs::path& file, std::optional<double> unit_m, const Observer& observer) {
  Scene scene = read_scene(file, observer);
  SceneObject& object = scene.objects.front();
  if (unit_m) set_mesh_unit(scene, file, *unit_m);
  for (SceneObject& each : scene.objects) {
    if (fs::path(each.mesh_file).extension() != ".obj")
      each.mesh_file = fs::path(each.mesh_file).replace_extension(".obj").string();
  }
  if (file.extension() != ".json") object.mesh_file = "textured.obj";
  return scene;
}

SceneTexture choose_texture(const Scene& scene, const fs::path& file, int index, const Observer& observer) {
  SceneTexture out;
  out.index = index >= 0 ? index : next_index(scene.objects.front());
  out.texture = read_texture(file, {}, observer);
  out.file = file.filename().string();
  for (int n = out.index; is_taken(scene, out.index, out.file); ++n) {
    out.file = fmt::format("{}-{}", n, file.filename().string());
  }
  return out;
}

Json stroke_json(const PaintResult& result, const SceneObject& object, const SceneTexture& texture) {
  Json out;
  out["format"] = "asperity-paint";
  out["version"] = 1;
  out["mesh"] = object.mesh_file;
  out["texture"] = {{"index", texture.index}, {"file", texture.file}};
  out["path_length_m"] = result.path.path.s_m.back();
  out["pick_distance_m"] = result.path.pick_distance_m;
  const HapticWarp& warp = result.warp;
  out["triangles"] = warp.triangles;
  out["painted_over"] = result.painted_over;
  out["warp"] = {
      {"stretch_min", warp.stretch_min}, {"stretch_max", warp.stretch_max},    {"stretch_rms", warp.stretch_rms},
      {"folded", warp.folded.size()},    {"stretched", warp.stretched.size()}, {"overlapping", warp.overlapping.size()},
      {"along_rms_m", warp.along_rms_m}, {"along_max_m", warp.along_max_m},    {"length_ratio", warp.length_ratio}};
  out["problems"] = Json::array();
  for (const Problem& problem : result.problems)
    out["problems"].push_back({{"kind", problem.kind}, {"message", problem.message}, {"count", problem.count}});
  return out;
}

}  // namespace asperity
