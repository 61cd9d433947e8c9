#include "asperity/session/paint_scene.h"

#include "asperity/base/text.h"
#include "asperity/geometry/mesh_unit.h"
#include "asperity/json/json.h"
#include "asperity/scene/lay_texture.h"
#include "asperity/scene/read_scene.h"
#include "asperity/scene/set_mesh_unit.h"
#include "asperity/scene/write_scene.h"
#include "asperity/texture/texture_file.h"

namespace asperity {

namespace fs = std::filesystem;

Scene read_painted_scene(const fs::path& file, std::optional<double> unit_m, const Observer& observer) {
  Scene scene = read_scene(file, observer);
  SceneObject& object = scene.objects.front();
  if (unit_m) {
    set_mesh_unit(scene, file, *unit_m);
  } else {
    refuse_unlikely_metres(object.mesh, file);
  }
  name_meshes_obj(scene);
  if (file.extension() != ".json") object.mesh_file = "textured.obj";
  return scene;
}

SceneTexture choose_texture(const Scene& scene, const fs::path& file, int index, const Observer& observer) {
  SceneTexture out;
  out.index = index >= 0 ? index : free_texture_index(scene.objects.front());
  out.texture = read_texture(file, {}, observer);
  out.file = free_file_name(scene, file.filename().string(), out.index, out.index);
  out.origin.emplace();
  out.origin->name = out.texture.name.empty() ? texture_stem(file) : out.texture.name;
  return out;
}

std::vector<std::string> covered_notes(std::span<const CoveredTexture> textures, const std::string& what) {
  std::vector<std::string> out;
  for (const CoveredTexture& covered : textures) {
    const std::string file = covered.file.empty() ? "" : " (" + printable(covered.file, 200) + ")";
    const std::string still = covered.rendered_still == 0
                                  ? "; no other triangle shows texture " + std::to_string(covered.index)
                                  : "; " + std::to_string(covered.rendered_still) + " others still show it";
    out.push_back(what + " covers texture " + std::to_string(covered.index) + file + " on " +
                  std::to_string(covered.triangles) + (covered.triangles == 1 ? " triangle" : " triangles") + still +
                  ". The scene keeps both; --under lays the new one below");
  }
  return out;
}

Json covered_json(std::span<const CoveredTexture> textures) {
  Json out = Json::array();
  for (const CoveredTexture& covered : textures) {
    out.push_back({{"index", covered.index},
                   {"file", covered.file.empty() ? Json(nullptr) : Json(covered.file)},
                   {"triangles", covered.triangles},
                   {"rendered_still", covered.rendered_still}});
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
  out["painted_under"] = result.painted_under;
  out["covered"] = covered_json(result.covered);
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
