#include "align/align_choice.h"

#include <algorithm>
#include <array>
#include <string_view>

#include "asperity/base/error.h"
#include "asperity/base/text.h"
#include "asperity/base/units.h"
#include "json_pose.h"

namespace asperity::studio {

namespace {

constexpr std::size_t kMostPaths = 16;
constexpr std::size_t kMostPicks = 1000;
constexpr std::size_t kMostSettings = 200;
constexpr std::size_t kLongestName = 1000;
constexpr std::array<std::string_view, 10> kKeys{"paths", "mesh",         "mesh_unit",  "textures", "config",
                                                 "picks", "T_mesh_world", "registered", "ran",      "area"};

std::string text_of(const Json& json, std::string_view what) {
  if (!json.is_string() || json.text().size() > kLongestName) {
    throw Error("align: " + std::string(what) + " is not text of at most 1000 bytes");
  }
  return json.get<std::string>();
}

const Json& part(const Json& json, const char* key, std::string_view what) {
  if (!json.is_object() || !json.contains(key)) throw Error("align: " + std::string(what) + " has no '" + key + "'");
  return json.at(key);
}

std::vector<std::string> names_of(const Json& json, std::string_view what) {
  if (!json.is_array() || json.size() > kMostPaths) {
    throw Error("align: " + std::string(what) + " is not a list of at most 16 names");
  }
  std::vector<std::string> out;
  for (const Json& name : json) out.push_back(text_of(name, what));
  return out;
}

std::vector<AlignChoice::Pick> picks_of(const Json& json) {
  if (!json.is_array() || json.size() > kMostPicks) throw Error("align: picks is not a list of at most 1000 pairs");
  std::vector<AlignChoice::Pick> out;
  for (const Json& pick : json) {
    out.push_back({point_of_json(part(pick, "path", "a pair"), "align: the point on the path"),
                   point_of_json(part(pick, "mesh", "a pair"), "align: the point on the mesh")});
  }
  return out;
}

std::optional<Pose> guess_of(const Json& json, std::string_view what) {
  const Json& guess = part(json, "guess", what);
  if (guess.is_null()) return std::nullopt;
  return pose_of_json(guess, "align: the guess");
}

AlignChoice::Registered registered_of(const Json& json) {
  AlignChoice::Registered out;
  out.guess = guess_of(json, "registered");
  const Json& near = part(json, "near", "registered");
  if (!near.is_boolean()) throw Error("align: registered.near is neither true nor false");
  out.near = near.get<bool>();
  out.T_mesh_world = pose_of_json(part(json, "T_mesh_world", "registered"), "align: the registered pose");
  return out;
}

// Throws Error for a setting that the registration does not know or take.
std::map<std::string, std::string> settings_of(const Json& json, std::string_view what) {
  if (!json.is_object() || json.size() > kMostSettings) {
    throw Error("align: " + std::string(what) + " is not an object of settings");
  }
  AlignChoice out;
  for (const auto& [path, value] : json.items()) out.config[path] = text_of(value, path);
  config_of(out);
  return out.config;
}

AlignChoice::LastRun last_run_of(const Json& json) {
  AlignChoice::LastRun out;
  out.guess = guess_of(json, "ran");
  out.paths = names_of(part(json, "paths", "ran"), "ran.paths");
  out.mesh = text_of(part(json, "mesh", "ran"), "ran.mesh");
  out.mesh_unit = text_of(part(json, "mesh_unit", "ran"), "ran.mesh_unit");
  if (!out.mesh_unit.empty()) parse_length_unit_m(out.mesh_unit, "ran.mesh_unit");
  if (json.contains("config")) out.config = settings_of(json.at("config"), "ran.config");
  return out;
}

AlignChoice::Area area_of(const Json& json) {
  AlignChoice::Area out;
  out.folder = text_of(part(json, "folder", "area"), "area.folder");
  const Json& config = part(json, "config", "area");
  if (!config.is_object() || config.size() > kMostSettings)
    throw Error("align: area.config is not an object of settings");
  for (const auto& [path, value] : config.items()) out.settings[path] = text_of(value, path);
  out.config();
  return out;
}

Json json_of_settings(const std::map<std::string, std::string>& settings) {
  Json out = Json::object();
  for (const auto& [path, value] : settings) out[path] = value;
  return out;
}

}  // namespace

Json json_of_last_run(const AlignChoice::LastRun& ran) {
  Json out;
  out["guess"] = ran.guess ? json_of_pose(*ran.guess) : Json();
  out["paths"] = ran.paths;
  out["mesh"] = ran.mesh;
  out["mesh_unit"] = ran.mesh_unit;
  out["config"] = json_of_settings(ran.config);
  return out;
}

Json json_of_choice(const AlignChoice& choice) {
  Json out;
  out["paths"] = choice.paths;
  out["mesh"] = choice.mesh;
  out["mesh_unit"] = choice.mesh_unit;
  out["textures"] = choice.textures;
  out["config"] = json_of_settings(choice.config);
  out["picks"] = Json::array();
  for (const AlignChoice::Pick& pick : choice.picks) {
    Json pair;
    pair["path"] = json_of_point(pick.p_world_m);
    pair["mesh"] = json_of_point(pick.p_mesh_m);
    out["picks"].push_back(std::move(pair));
  }
  if (choice.T_mesh_world) out["T_mesh_world"] = json_of_pose(*choice.T_mesh_world);
  if (choice.registered) {
    Json& registered = out["registered"];
    registered["guess"] = choice.registered->guess ? json_of_pose(*choice.registered->guess) : Json();
    registered["near"] = choice.registered->near;
    registered["T_mesh_world"] = json_of_pose(choice.registered->T_mesh_world);
  }
  if (choice.ran) out["ran"] = json_of_last_run(*choice.ran);
  out["area"] = {{"folder", choice.area.folder}, {"config", json_of_settings(choice.area.settings)}};
  return out;
}

AlignChoice choice_of_json(const Json& section) {
  if (!section.is_object()) throw Error("align: the section is not an object");
  for (const auto& [key, value] : section.items()) {
    if (std::find(kKeys.begin(), kKeys.end(), key) == kKeys.end()) {
      throw Error("align: unknown key '" + printable(key) + "'");
    }
  }
  AlignChoice out;
  out.paths = names_of(part(section, "paths", "the section"), "paths");
  out.mesh = text_of(part(section, "mesh", "the section"), "mesh");
  out.mesh_unit = text_of(part(section, "mesh_unit", "the section"), "mesh_unit");
  if (!out.mesh_unit.empty()) parse_length_unit_m(out.mesh_unit, "the mesh's unit");
  out.textures = names_of(part(section, "textures", "the section"), "textures");
  out.config = settings_of(part(section, "config", "the section"), "config");
  out.picks = picks_of(part(section, "picks", "the section"));
  if (section.contains("T_mesh_world")) out.T_mesh_world = pose_of_json(section.at("T_mesh_world"), "align: the pose");
  if (section.contains("registered")) out.registered = registered_of(section.at("registered"));
  if (section.contains("ran")) out.ran = last_run_of(section.at("ran"));
  if (section.contains("area")) out.area = area_of(section.at("area"));
  return out;
}

bool is_of_scene(const AlignChoice& choice) { return choice.mesh.ends_with(".json"); }

MeshReading reading_of(const AlignChoice& choice) {
  return mesh_reading(choice.mesh, choice.mesh_unit, choice.project);
}

std::optional<double> unit_to_read_m(const AlignChoice& choice) {
  return is_of_scene(choice) ? std::nullopt : std::optional(reading_of(choice).unit_m);
}

AreaConfig AlignChoice::Area::config() const {
  AreaConfig out;
  const std::vector<ConfigField> fields = list_fields("", out);
  for (const auto& [path, value] : settings) set_field(fields, path, value);
  return out;
}

RegisterConfig config_of(const AlignChoice& choice) {
  RegisterConfig out;
  const std::vector<ConfigField> fields = list_fields("", out);
  for (const auto& [path, value] : choice.config) set_field(fields, path, value);
  return out;
}

}  // namespace asperity::studio
