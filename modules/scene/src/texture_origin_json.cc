#include "texture_origin_json.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include "asperity/base/error.h"
#include "asperity/json/config_json.h"
#include "scene_json.h"

namespace asperity {

namespace {

constexpr std::size_t kMostPicks = 100'000;
constexpr double kFarthestPick_m = 1e6;
constexpr std::array<std::string_view, 10> kOriginKeys{"kind",         "name",      "checksum",       "fingerprint",
                                                       "T_mesh_world", "placement", "strokes_mesh_m", "date",
                                                       "asperity",     "settings"};

}  // namespace

TextureOrigin parse_texture_origin(const JsonItem& item) {
  JsonObject in(item);
  TextureOrigin out;
  in.read_text("kind", out.kind);
  in.read_text("name", out.name);
  in.read_text("checksum", out.checksum);
  if (const auto fingerprint = in.optional_object("fingerprint")) out.fingerprint = fingerprint->item().json();
  if (const auto pose = in.optional("T_mesh_world")) out.T_mesh_world = parse_pose(*pose);
  if (const auto placement = in.optional("placement"))
    out.placement = static_cast<int>(placement->integer(1, kMostPicks));
  if (const auto strokes = in.optional("strokes_mesh_m")) {
    for (const JsonItem& stroke : strokes->elements(kMostPicks)) {
      std::vector<Eigen::Vector3d>& picks_m = out.strokes_mesh_m.emplace_back();
      for (const JsonItem& pick : stroke.elements(kMostPicks)) {
        pick.numbers(picks_m.emplace_back().data(), 3, {-kFarthestPick_m, kFarthestPick_m});
      }
    }
  }
  in.read_text("date", out.date);
  in.read_text("asperity", out.version);
  if (const auto settings = in.optional_object("settings")) out.settings = settings->item().json();
  for (const auto& [key, value] : item.json().items()) {
    if (std::find(kOriginKeys.begin(), kOriginKeys.end(), key) == kOriginKeys.end()) out.rest[key] = value;
  }
  return out;
}

Json changed_settings(const std::vector<ConfigField>& fields, const std::vector<ConfigField>& usual) {
  if (fields.size() != usual.size()) throw Error("settings: the two lists have not the same fields");
  Json out = Json::object();
  for (std::size_t i = 0; i < fields.size(); ++i) {
    const ConfigValue value = fields[i].get();
    if (value != usual[i].get()) out[fields[i].path] = config_value_json(value);
  }
  return out;
}

Json format_texture_origin(const TextureOrigin& origin) {
  Json out = Json::object();
  const auto add = [&out](std::string_view key, const std::string& text) {
    if (!text.empty()) out[key] = text;
  };
  add("kind", origin.kind);
  add("name", origin.name);
  add("checksum", origin.checksum);
  if (origin.fingerprint.is_object()) out["fingerprint"] = origin.fingerprint;
  if (origin.T_mesh_world) out["T_mesh_world"] = format_pose(*origin.T_mesh_world);
  if (origin.placement) out["placement"] = *origin.placement;
  for (const auto& stroke : origin.strokes_mesh_m) {
    Json picks = Json::array();
    for (const Eigen::Vector3d& p_m : stroke) picks.push_back({p_m.x(), p_m.y(), p_m.z()});
    out["strokes_mesh_m"].push_back(std::move(picks));
  }
  add("date", origin.date);
  add("asperity", origin.version);
  if (!origin.settings.empty()) out["settings"] = origin.settings;
  out.update(origin.rest);
  return out;
}

}  // namespace asperity
