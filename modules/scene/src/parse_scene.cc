#include "parse_scene.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>

#include "asperity/base/error.h"
#include "asperity/base/text.h"
#include "asperity/scene/read_scene.h"

namespace asperity {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kMostTextures = 10000, kMostObjects = 1000;
constexpr double kLargestUnit_m = 1e6, kSmallestUnit_m = 1e-12;
constexpr double kStiffest_N_per_m = 1e9, kRoughest = 100.0;

// A value of the document and where it stands, for messages.
class Place {
 public:
  Place(const Json& value, std::string file, std::string path)
      : value_(value), file_(std::move(file)), path_(std::move(path)) {}

  [[noreturn]] void fail(const std::string& message) const {
    throw Error(file_ + ": " + (path_.empty() ? "the document" : "'" + printable(path_) + "'") + " " + message);
  }
  bool has(const char* key) const { return value_.contains(key); }
  Place at(const char* key) const {
    if (!has(key)) fail(std::string("has no '") + key + "'");
    return {value_.at(key), file_, path_.empty() ? key : path_ + "." + key};
  }
  Place at(std::size_t i) const { return {value_.at(i), file_, path_ + "[" + std::to_string(i) + "]"}; }

  void only(std::initializer_list<std::string_view> known) const {
    if (!value_.is_object()) fail("is not an object");
    for (const auto& [key, value] : value_.items()) {
      if (std::find(known.begin(), known.end(), key) == known.end())
        fail("has an unknown key '" + printable(key) + "'");
    }
  }
  std::size_t list(std::size_t most) const {
    if (!value_.is_array()) fail("is not a list");
    if (value_.size() > most)
      fail("has " + std::to_string(value_.size()) + " entries, more than " + std::to_string(most));
    return value_.size();
  }
  double number(double low, double high) const {
    if (!value_.is_number()) fail("is not a number");
    const double number = value_.get<double>();
    if (!(number >= low && number <= high)) {
      fail("is " + number_text(number) + ", not within " + number_text(low) + " and " + number_text(high));
    }
    return number;
  }
  std::int64_t integer(std::int64_t low, std::int64_t high) const {
    if (!value_.is_number_integer()) fail("is not a whole number");
    return static_cast<std::int64_t>(number(static_cast<double>(low), static_cast<double>(high)));
  }
  // The name of a file in the scene's folder or below.
  std::string file_name() const {
    if (!value_.is_string()) fail("is not a text");
    auto name = value_.get<std::string>();
    if (!stays_inside(name)) fail("names '" + printable(name) + "', which is not a file in the scene's folder");
    return name;
  }
  Pose pose() const {
    if (list(7) != 7) fail("is not [x, y, z, qw, qx, qy, qz]");
    std::array<double, 7> v{};
    for (std::size_t i = 0; i < v.size(); ++i) v[i] = at(i).number(-1e6, 1e6);
    const Eigen::Quaterniond q(v[3], v[4], v[5], v[6]);
    constexpr double kNormTolerance = 1e-6;
    if (!(std::abs(q.norm() - 1.0) < kNormTolerance)) fail("has a quaternion that is not of unit length");
    return {q, {v[0], v[1], v[2]}};
  }
  const Json& value() const { return value_; }

 private:
  const Json& value_;
  std::string file_, path_;
};

SceneObject parse_object(const Place& place) {
  SceneObject object;
  object.mesh_file = place.at("mesh").file_name();
  if (place.has("unit_m")) object.unit_m = place.at("unit_m").number(kSmallestUnit_m, kLargestUnit_m);
  if (place.has("material")) object.material_file = place.at("material").file_name();
  if (place.has("T_world_mesh")) object.T_world_mesh = place.at("T_world_mesh").pose();
  if (!place.has("textures")) return object;
  const Place textures = place.at("textures");
  const std::size_t count = textures.list(kMostTextures);
  std::set<int> seen;
  for (std::size_t i = 0; i < count; ++i) {
    const Place texture = textures.at(i);
    texture.only({"index", "file"});
    SceneTexture entry;
    entry.index = static_cast<int>(texture.at("index").integer(0, std::numeric_limits<std::int32_t>::max()));
    entry.file = texture.at("file").file_name();
    if (!seen.insert(entry.index).second)
      texture.fail("has the index " + std::to_string(entry.index) + " a second time");
    object.textures.push_back(std::move(entry));
  }
  std::sort(object.textures.begin(), object.textures.end(),
            [](const SceneTexture& a, const SceneTexture& b) { return a.index < b.index; });
  return object;
}

// nlohmann parses nested documents recursively: what is nested deeper than any scene is refused first.
void check_depth(std::string_view text, const std::string& name) {
  constexpr int kDeepest = 32;
  int depth = 0;
  bool quoted = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (quoted) {
      if (text[i] == '\\')
        ++i;
      else if (text[i] == '"')
        quoted = false;
      continue;
    }
    if (text[i] == '"') quoted = true;
    if (text[i] == '{' || text[i] == '[') ++depth;
    if (text[i] == '}' || text[i] == ']') --depth;
    if (depth > kDeepest) throw Error(name + ": nested deeper than " + std::to_string(kDeepest));
  }
}

Json parse_json(std::string_view text, const std::string& name) {
  check_depth(text, name);
  try {
    return Json::parse(text);
  } catch (const Json::exception& error) {
    throw Error(name + ": " + printable(error.what(), 200));
  }
}

}  // namespace

Scene parse_scene(std::string_view text, const std::string& name) {
  const Json json = parse_json(text, name);
  const Place root(json, name, "");
  root.only({"format", "version", "mesh", "unit_m", "textures", "stiffness_N_per_m", "friction", "T_mesh_world",
             "T_world_mesh", "material", "objects", "extra"});
  if (root.at("format").value() != "asperity-scene") root.at("format").fail("is not \"asperity-scene\"");
  if (root.at("version").integer(0, 1000000) != 1)
    root.at("version").fail("is not 1, the only one that this program knows");

  Scene scene;
  scene.objects.push_back(parse_object(root));
  if (root.has("stiffness_N_per_m"))
    scene.stiffness_N_per_m = root.at("stiffness_N_per_m").number(0.0, kStiffest_N_per_m);
  if (root.has("friction")) scene.friction = root.at("friction").number(0.0, kRoughest);
  if (root.has("T_mesh_world")) scene.T_mesh_world = root.at("T_mesh_world").pose();
  if (root.has("objects")) {
    const Place objects = root.at("objects");
    const std::size_t count = objects.list(kMostObjects);
    for (std::size_t i = 0; i < count; ++i) {
      const Place object = objects.at(i);
      object.only({"mesh", "unit_m", "textures", "material", "T_world_mesh"});
      scene.objects.push_back(parse_object(object));
    }
  }
  if (root.has("extra")) {
    if (!root.at("extra").value().is_object()) root.at("extra").fail("is not an object");
    scene.extra_json = root.at("extra").value().dump();
  }
  return scene;
}

}  // namespace asperity
