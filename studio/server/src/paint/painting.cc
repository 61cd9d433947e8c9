#include "painting.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <string_view>

#include "asperity/base/error.h"
#include "asperity/base/text.h"
#include "asperity/registration/triangle_stretch.h"
#include "asperity/scene/swap_texture.h"
#include "asperity/session/paint_scene.h"
#include "asperity/studio/calls.h"
#include "asperity/texture/texture_file.h"
#include "json_keys.h"
#include "mesh_block.h"

namespace asperity::studio {

namespace {

double number_of(const Json& value, const char* what, double low, double high) {
  const double number = value.is_number() ? value.get<double>() : std::numeric_limits<double>::quiet_NaN();
  if (!(number >= low && number <= high)) throw Error(std::string("paint: ") + what + " is out of range");
  return number;
}

std::string text_of(const Json& value, const char* what) {
  constexpr std::size_t kLongest = 1000;
  if (!value.is_string() || value.text().size() > kLongest) throw Error(std::string("paint: ") + what + " is not text");
  return value.get<std::string>();
}

Stroke stroke_of(const Json& json) {
  refuse_unknown(json, {"picks_m", "texture", "index"}, "paint");
  Stroke out;
  out.texture = text_of(json.at("texture"), "a stroke's texture");
  out.index = static_cast<int>(number_of(json.at("index"), "a stroke's index", 0, 1e6));
  if (!json.at("picks_m").is_array() || json.at("picks_m").size() > kMostPicks) {
    throw Advice("a stroke can have " + std::to_string(kMostPicks) + " points at most",
                 "Finish this one, and start another where it ends.");
  }
  for (const Json& pick : json.at("picks_m")) {
    if (!pick.is_array() || pick.size() != 3) throw Error("paint: a point is not three numbers");
    out.picks_m.emplace_back(number_of(pick[0], "x", -1e6, 1e6), number_of(pick[1], "y", -1e6, 1e6),
                             number_of(pick[2], "z", -1e6, 1e6));
  }
  return out;
}

// Textures of several strokes with one index are the newest one's.
PaintedStroke paint_one(Scene& scene, const Stroke& stroke, const Project& project,
                        const HapticCoordinatesConfig& coordinates, const Observer& observer) {
  PaintedStroke out;
  out.texture = choose_texture(scene, project.existing(stroke.texture), stroke.index, observer);
  try {
    out.result = paint(scene.objects.front(), stroke.picks_m, out.texture, coordinates);
  } catch (const Cancelled&) {
    throw;
  } catch (const Error& error) {
    out.fault = error.what();
  }
  return out;
}

// The farther from 1 of the two, as a factor: 1.2 where lengths grow by a fifth, -1.2 where they shrink as much.
float worst_stretch(const TriangleStretch& stretch) {
  if (!stretch.known || stretch.low <= 0.0) return std::numeric_limits<float>::quiet_NaN();
  const double squeeze = 1.0 / stretch.low;
  return static_cast<float>(stretch.high >= squeeze ? stretch.high : -squeeze);
}

Json textures_json(const SceneObject& object) {
  Json out = Json::array();
  for (const SceneTexture& texture : object.textures) {
    Json one;
    one["index"] = texture.index;
    one["file"] = texture.file;
    one["name"] = texture.texture.name;
    out.push_back(std::move(one));
  }
  return out;
}

}  // namespace

Json first_painting() {
  return {
      {"object", ""},  {"rings", 1},   {"half_width_mm", 0.0}, {"strokes", Json::array()}, {"swaps", Json::object()},
      {"current", -1}, {"written", ""}};
}

Painting parse_painting(const Json& section) {
  refuse_unknown(section, {"object", "unit_m", "rings", "half_width_mm", "strokes", "swaps", "current", "written"},
                 "paint");
  Painting out;
  out.object = text_of(section.at("object"), "the object");
  if (const Json* unit_m = section.find("unit_m"))
    out.unit = number_text(number_of(*unit_m, "the unit", 1e-9, 1e6)) + "m";
  out.coordinates.rings = static_cast<int>(number_of(section.at("rings"), "the number of rings", 0, 1000));
  out.coordinates.half_width_mm = number_of(section.at("half_width_mm"), "half the width", 0.0, 1e6);
  if (!section.at("strokes").is_array() || section.at("strokes").size() > kMostStrokes) {
    throw Advice("a scene can have " + std::to_string(kMostStrokes) + " strokes at most",
                 "Write the scene, and continue to paint on that scene.");
  }
  for (const Json& stroke : section.at("strokes")) out.strokes.push_back(stroke_of(stroke));
  text_of(section.at("written"), "the scene that was written");
  number_of(section.at("current"), "the chosen stroke", -1, kMostStrokes);
  for (const auto& [index, texture] : section.at("swaps").items()) {
    if (index.empty() || index.size() > 6 || index.find_first_not_of("0123456789") != std::string::npos) {
      throw Error("paint: '" + index + "' is not the number of a texture");
    }
    out.swaps[std::stoi(index)] = text_of(texture, "a texture");
  }
  return out;
}

PaintedScene paint_all(Scene scene, const Painting& painting, const Project& project, const Observer& observer) {
  PaintedScene out{std::move(scene), {}};
  for (std::size_t i = 0; i < painting.strokes.size(); ++i) {
    observer.update("painting", static_cast<double>(i) / static_cast<double>(painting.strokes.size()));
    out.strokes.push_back(paint_one(out.scene, painting.strokes[i], project, painting.coordinates, observer));
  }
  for (const auto& [index, texture] : painting.swaps) {
    const SceneTexture chosen = choose_texture(out.scene, project.existing(texture), index, observer);
    swap_texture(out.scene, index, chosen.texture, chosen.file);
  }
  return out;
}

BlockWriter painted_block(const PaintedScene& painted) {
  const SceneObject& object = painted.scene.objects.front();
  const TriangleMesh mesh = to_metres(object.mesh, object.unit_m);
  BlockWriter out = mesh_block("painted", mesh);
  out.head()["textures"] = textures_json(object);
  const std::size_t count = mesh.triangles.size();
  std::vector<std::int32_t> texture(count, -1);
  std::vector<float> xy_mm(6 * count, 0.0F);
  std::vector<float> stretch(count, std::numeric_limits<float>::quiet_NaN());
  std::vector<std::uint8_t> folded(count, 0);
  for (std::size_t t = 0; t < object.mesh.haptic.size(); ++t) {
    const HapticTriangle& haptic = object.mesh.haptic[t];
    texture[t] = haptic.texture;
    if (haptic.texture < 0) continue;
    for (std::size_t k = 0; k < 3; ++k) {
      xy_mm[6 * t + 2 * k] = static_cast<float>(haptic.xy_mm[k].x());
      xy_mm[6 * t + 2 * k + 1] = static_cast<float>(haptic.xy_mm[k].y());
    }
    const TriangleStretch one = triangle_stretch(mesh, static_cast<std::uint32_t>(t), haptic);
    stretch[t] = worst_stretch(one);
    folded[t] = one.known && one.folded ? 1 : 0;
  }
  out.add("texture", std::span<const std::int32_t>(texture));
  out.add("xy_mm", std::span<const float>(xy_mm), {count, 3, 2});
  out.add("stretch", std::span<const float>(stretch));
  out.add("folded", std::span<const std::uint8_t>(folded));

  Json strokes = Json::array();
  for (std::size_t i = 0; i < painted.strokes.size(); ++i) {
    const PaintedStroke& stroke = painted.strokes[i];
    if (!stroke.fault.empty()) {
      strokes.push_back(Json{{"fault", stroke.fault}});
      continue;
    }
    strokes.push_back(stroke_json(stroke.result, object, stroke.texture));
    std::vector<double> path;
    for (const Eigen::Vector3d& p_m : stroke.result.path.path.p_mesh_m) path.insert(path.end(), p_m.begin(), p_m.end());
    out.add("path_" + std::to_string(i), std::span<const double>(path), {path.size() / 3, 3});
  }
  out.head()["strokes"] = std::move(strokes);
  return out;
}

}  // namespace asperity::studio
