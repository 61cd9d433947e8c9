#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "asperity/base/progress.h"
#include "asperity/device/haptic_device.h"
#include "asperity/render/render_model.h"
#include "asperity/scene/scene.h"
#include "asperity/session/feel_settings.h"

namespace asperity {

// The input to be rendered: a scene or images.
struct SceneInput {
  std::string scene;                     // scene.json, its folder, or a mesh
  std::optional<double> mesh_unit_m;     // length of a mesh's unit; none: as the file says, or 1 m
  std::vector<std::string> height_maps;  // files, instead of a scene
  double tile_mm = 10.0;                 // side of a height map
  double height_range_mm = 2.5;          // from black to white
  std::optional<std::array<Eigen::Vector3d, 2>> tile_stroke_m;  // across the first row of tiles
};

// Reads it. Images become tiles of a plane (thesis Fig. 38), rendered by Basdogan's model unless the settings name
// another. Throws Error naming the file, WrongUnit and UnlikelyMetres (geometry/mesh_unit.h).
Scene read_scene_input(SceneInput& input, FeelSettings& settings, const Observer& observer = {});

struct PreparedModel {
  std::unique_ptr<const RenderModel> model;
  std::vector<std::string> warnings;  // what the device's caps changed, in words
};

// A scene ready for the servo: within what the device can render and, unless the settings say where, with the middle
// of its workspace in the middle of the scene. For a driven device the scene is left as it is.
PreparedModel prepare_render_model(const Scene& scene, const DeviceInfo& device, bool driven, FeelSettings& settings);

}  // namespace asperity
