#include "parse_scene.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>

#include "asperity/base/text.h"
#include "asperity/json/json_object.h"
#include "asperity/json/parse_json.h"
#include "asperity/scene/read_scene.h"

namespace asperity {

namespace {

constexpr std::size_t kMostTextures = 10000, kMostObjects = 1000;
constexpr double kLargestUnit_m = 1e6, kSmallestUnit_m = 1e-12;
constexpr double kStiffest_N_per_m = 1e9, kRoughest = 100.0, kFarthest_m = 1e6;

// The name of a file in the scene's folder or below.
std::string file_name(const JsonItem& item) {
  const std::string& name = item.text();
  if (!stays_inside(name)) item.fail("names '" + printable(name) + "', which is not a file in the scene's folder");
  return name;
}

Pose pose_of(const JsonItem& item) {
  std::array<double, 7> v{};
  item.numbers(v.data(), v.size(), {-kFarthest_m, kFarthest_m});
  const Eigen::Quaterniond q(v[3], v[4], v[5], v[6]);
  constexpr double kNormTolerance = 1e-6;
  if (!(std::abs(q.norm() - 1.0) < kNormTolerance)) item.fail("has a quaternion that is not of unit length");
  return {q, {v[0], v[1], v[2]}};
}

SceneObject parse_object(JsonObject& in) {
  SceneObject object;
  object.mesh_file = file_name(in.required("mesh"));
  in.read_number("unit_m", object.unit_m, {kSmallestUnit_m, kLargestUnit_m});
  if (const auto material = in.optional("material")) object.material_file = file_name(*material);
  if (const auto pose = in.optional("T_world_mesh")) object.T_world_mesh = pose_of(*pose);
  const auto textures = in.optional("textures");
  if (!textures) return object;
  std::set<int> seen;
  for (JsonItem& item : textures->elements(kMostTextures)) {
    JsonObject texture(std::move(item));
    SceneTexture entry;
    const JsonItem index = texture.required("index");
    entry.index = static_cast<int>(index.integer(0, std::numeric_limits<std::int32_t>::max()));
    entry.file = file_name(texture.required("file"));
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
  if (const auto pose = root.optional("T_mesh_world")) scene.T_mesh_world = pose_of(*pose);
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
