#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "asperity/device/haptic_device.h"
#include "asperity/render/render_model.h"
#include "asperity/scene/scene.h"
#include "feel_settings.h"

namespace asperity::app {

// What is to be felt, as the command line says it: a scene or images.
struct SceneInput {
  std::string scene;  // scene.json, its folder, or a mesh
  std::string mesh_unit;
  std::string height_map_list;           // as given: a.png,b.png,…
  std::vector<std::string> height_maps;  // its files
  std::string tile, height_range;
  std::optional<std::array<Eigen::Vector3d, 2>> tile_stroke_m;  // across the first row of tiles
};

// Takes the list of images apart. Throws UsageError for options that do not go together.
void check_scene_input(SceneInput& input);

// Reads it. Images become tiles of a plane (seed Fig. 38), rendered by Basdogan's model unless the settings name
// another. Throws Error naming the file.
Scene read_felt_scene(SceneInput& input, FeelSettings& settings);

struct FeltModel {
  std::unique_ptr<const RenderModel> model;
  std::vector<std::string> warnings;  // what the device's caps changed, in words
};

// A scene ready for the servo: within what the device can render and, unless the settings say where, with the middle
// of its workspace in the middle of the scene. For a driven device the scene is left as it is.
FeltModel make_felt_model(const Scene& scene, const DeviceInfo& device, bool driven, FeelSettings& settings);

}  // namespace asperity::app
