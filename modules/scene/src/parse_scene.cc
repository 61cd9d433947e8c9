#include "parse_scene.h"

#include <algorithm>
#include <limits>
#include <set>

#include "asperity/base/text.h"
#include "asperity/json/json_object.h"
#include "asperity/json/parse_json.h"
#include "asperity/scene/lay_texture.h"
#include "asperity/scene/read_scene.h"
#include "scene_json.h"
#include "texture_origin_json.h"

namespace asperity {

namespace {

constexpr std::size_t kMostTextures = 10000, kMostObjects = 1000;
constexpr double kLargestUnit_m = 1e6, kSmallestUnit_m = 1e-12;
constexpr double kStiffest_N_per_m = 1e9, kRoughest = 100.0;

// The name of a file in the scene's folder or below.
std::string file_name(const JsonItem& item) {
  const std::string& name = item.text();
  if (!stays_inside(name)) item.fail("names '" + printable(name) + "', which is not a file in the scene's folder");
  return name;
}

SceneObject parse_object(JsonObject& in) {
  SceneObject object;
  object.mesh_file = file_name(in.required("mesh"));
  in.read_number("unit_m", object.unit_m, {kSmallestUnit_m, kLargestUnit_m});
  if (const auto covered = in.optional("covered")) object.covered_file = file_name(*covered);
  if (const auto material = in.optional("material")) object.material_file = file_name(*material);
  if (const auto pose = in.optional("T_world_mesh")) object.T_world_mesh = parse_pose(*pose);
  const auto textures = in.optional("textures");
  if (!textures) return object;
  std::set<int> seen;
  for (JsonItem& item : textures->elements(kMostTextures)) {
    JsonObject texture(std::move(item));
    SceneTexture entry;
    const JsonItem index = texture.required("index");
    entry.index = static_cast<int>(index.integer(0, std::numeric_limits<std::int32_t>::max()));
    entry.file = file_name(texture.required("file"));
    if (const auto order = texture.optional("order"))
      entry.order = static_cast<int>(order->integer(-kFurthestOrder, kFurthestOrder));
    if (const auto source = texture.optional("source")) entry.origin = parse_texture_origin(*source);
    texture.finish();
    if (!seen.insert(entry.index).second) index.fail("the index " + std::to_string(entry.index) + " a second time");
    object.textures.push_back(std::move(entry));
  }
  std::sort(object.textures.begin(), object.textures.end(),
            [](const SceneTexture& a, const SceneTexture& b) { return a.index < b.index; });
  return object;
}

}  // namespace

Scene parse_scene(std::string_view text, const std::string& name, const Observer& observer) {
  const Json json = parse_json(text, name, {}, observer.without_progress());
  JsonObject root(json, name);
  root.require_format("asperity-scene");
  Scene scene;
  scene.objects.push_back(parse_object(root));
  if (const auto stiffness = root.optional("stiffness_N_per_m")) {
    scene.stiffness_N_per_m = stiffness->number({0.0, kStiffest_N_per_m});
  }
  if (const auto friction = root.optional("friction")) scene.friction = friction->number({0.0, kRoughest});
  if (const auto ratio = root.optional("static_friction_ratio"))
    scene.static_friction_ratio = ratio->number({1.0, kRoughest});
  if (const auto pose = root.optional("T_mesh_world")) scene.T_mesh_world = parse_pose(*pose);
  if (const auto objects = root.optional("objects")) {
    for (JsonItem& item : objects->elements(kMostObjects)) {
      JsonObject object(std::move(item));
      scene.objects.push_back(parse_object(object));
      object.finish();
    }
  }
  scene.extra = root.extra();
  root.finish();
  return scene;
}

}  // namespace asperity
