#include "feel/feel_setup.h"

#include <array>
#include <utility>

#include "asperity/base/error.h"
#include "asperity/base/text.h"
#include "asperity/base/units.h"
#include "asperity/scene/swap_texture.h"
#include "asperity/studio/calls.h"
#include "asperity/texture/texture_file.h"
#include "feel/feel_devices.h"

namespace asperity::studio {

namespace {

constexpr std::array<std::string_view, 4> kGroups{"render.", "stroke.", "hand.", "pointer."};
constexpr std::array<std::string_view, 8> kSingles{"servo.rate_Hz",          "servo.timed",
                                                   "servo.velocity_noise_m", "servo.frame.R_world_device_xyzw",
                                                   "servo.frame.scale",      "servo.frame.translation_m",
                                                   "audio.vibration.volume", "gamepad.volume"};

bool is_settable(std::string_view path) {
  for (const std::string_view group : kGroups) {
    if (path.starts_with(group)) return true;
  }
  for (const std::string_view single : kSingles) {
    if (path == single) return true;
  }
  return false;
}

}  // namespace

std::vector<ConfigField> settable_fields(FeelConfig& config) {
  std::vector<ConfigField> out;
  for (ConfigField& field : feel_config_fields(config)) {
    if (is_settable(field.path)) out.push_back(std::move(field));
  }
  return out;
}

bool is_live(std::string_view path) { return path.starts_with("render."); }

FeelSetup resolve_choices(const FeelChoices& choices, const FeelConfig& start, const Project& project,
                          const ProjectSetup& project_setup) {
  if (choices.empty()) throw Advice("no scene is chosen", "Choose a scene, a mesh or height maps.");
  FeelSetup out;
  out.config = start;
  const std::vector<ConfigField> fields = settable_fields(out.config);
  for (const auto& [path, value] : choices.settings) set_field(fields, path, value);
  if (!is_feel_device(choices.device)) {
    throw Advice("unknown device '" + printable(choices.device, 100) + "'", "Choose a device of the list.");
  }
  out.device = choices.device;
  if (!choices.replay.empty()) out.replay = project.existing(choices.replay).string();
  out.mapped = choices.mapped;
  if (!choices.scene.empty()) {
    out.input.scene = project.existing(choices.scene).string();
    out.reading = mesh_reading(out.input.scene, choices.mesh_unit, project_setup);
    if (out.reading.from != MeshReading::From::kFile) out.input.mesh_unit_m = out.reading.unit_m;
  }
  for (const std::string& image : choices.height_maps) {
    out.input.height_maps.push_back(project.existing(image).string());
  }
  if (!choices.height_maps.empty()) {
    out.input.tile_mm = choices.tile_mm;
    out.input.height_range_mm = choices.range_mm;
  }
  for (const auto& [index, file] : choices.textures) out.textures.emplace(index, project.existing(file));
  return out;
}

Scene read_chosen_scene(FeelSetup& setup, const Observer& observer) {
  Scene scene = read_scene_input(setup.input, setup.config.feel, observer);
  if (setup.input.height_maps.empty()) check_assumed_unit(scene.objects.front().mesh, setup.input.scene, setup.reading);
  for (const auto& [index, file] : setup.textures) {
    swap_texture(scene, index, read_texture(file, {}, observer), file.filename().string());
  }
  return scene;
}

}  // namespace asperity::studio
