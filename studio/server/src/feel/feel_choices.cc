#include "feel/feel_choices.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "asperity/base/error.h"
#include "asperity/base/text.h"
#include "asperity/scene/height_map_viewer.h"

namespace asperity::studio {

namespace {

constexpr std::size_t kLongestText = 1000, kMostSettings = 200, kMostTextures = 1000;

[[noreturn]] void refuse(const std::string& key, const std::string& why) {
  throw Error("feel." + printable(key, 100) + ": " + why);
}

std::string text_of(const std::string& key, const Json& value) {
  if (!value.is_string()) refuse(key, "text is needed");
  auto text = value.get<std::string>();
  if (text.size() > kLongestText) refuse(key, "too long");
  return text;
}

double number_of(const std::string& key, const Json& value, double low, double high) {
  if (!value.is_number()) refuse(key, "a number is needed");
  const auto number = value.get<double>();
  if (!(number >= low && number <= high)) {
    refuse(key, number_text(number) + " is not between " + number_text(low) + " and " + number_text(high));
  }
  return number;
}

// A setting's value in the notation of ConfigField::set.
std::string setting_text(const std::string& key, const Json& value) {
  if (value.is_string()) return '"' + text_of(key, value) + '"';
  if (value.is_boolean()) return value.get<bool>() ? "true" : "false";
  if (value.is_number_integer()) return value.dump();
  if (value.is_number() && std::isfinite(value.get<double>())) return number_text(value.get<double>());
  if (value.is_array() && value.size() <= 16) {
    std::string out = "[";
    for (const Json& element : value) {
      if (!element.is_number()) refuse(key, "a list of numbers is needed");
      out += (out.size() > 1 ? ", " : "") + number_text(element.get<double>());
    }
    return out + "]";
  }
  refuse(key, "text, a number, numbers, or true or false is needed");
}

std::map<std::string, std::string> settings_of(const Json& value) {
  if (!value.is_object() || value.size() > kMostSettings) refuse("settings", "an object of settings is needed");
  std::map<std::string, std::string> out;
  for (const auto& [path, setting] : value.items()) out[path] = setting_text("settings." + path, setting);
  return out;
}

std::map<int, std::string> textures_of(const Json& value) {
  if (!value.is_object() || value.size() > kMostTextures) refuse("textures", "an object of files is needed");
  std::map<int, std::string> out;
  for (const auto& [index, file] : value.items()) {
    int number = 0;
    const auto read = std::from_chars(index.data(), index.data() + index.size(), number);
    if (read.ec != std::errc() || read.ptr != index.data() + index.size() || number < 0) {
      refuse("textures." + index, "it is not the number of a texture");
    }
    out[number] = text_of("textures." + index, file);
  }
  return out;
}

}  // namespace

Json first_feel_section() {
  return {{"scene", ""},
          {"mesh_unit", ""},
          {"height_maps", Json::array()},
          {"tile_mm", 10.0},
          {"range_mm", 2.5},
          {"device", "mouse"},
          {"replay", ""},
          {"mapped", false},
          {"settings", Json::object()},
          {"max_force_N", nullptr},
          {"textures", Json::object()}};
}

FeelChoices read_feel_choices(const Json& section) {
  if (!section.is_object()) throw Error("feel: an object is needed");
  FeelChoices out;
  for (const auto& [key, value] : section.items()) {
    if (key == "scene") {
      out.scene = text_of(key, value);
    } else if (key == "mesh_unit") {
      out.mesh_unit = text_of(key, value);
    } else if (key == "height_maps") {
      if (!value.is_array() || value.size() > kMostViewerTiles) refuse(key, "a list of images is needed");
      for (const Json& name : value) out.height_maps.push_back(text_of(key, name));
    } else if (key == "tile_mm") {
      out.tile_mm = number_of(key, value, 1e-3, 1e4);
    } else if (key == "range_mm") {
      out.range_mm = number_of(key, value, 1e-6, 1e3);
    } else if (key == "device") {
      out.device = text_of(key, value);
    } else if (key == "replay") {
      out.replay = text_of(key, value);
    } else if (key == "mapped") {
      if (!value.is_boolean()) refuse(key, "true or false is needed");
      out.mapped = value.get<bool>();
    } else if (key == "settings") {
      out.settings = settings_of(value);
    } else if (key == "max_force_N") {
      if (!value.is_null()) out.max_force_N = number_of(key, value, 0.0, 1e3);
    } else if (key == "textures") {
      out.textures = textures_of(value);
    } else {
      refuse(key, "unknown key");
    }
  }
  if (!out.scene.empty() && !out.height_maps.empty()) refuse("scene", "choose either a scene or height maps");
  return out;
}

}  // namespace asperity::studio
