#include "asperity/session/feel_scene.h"

#include <filesystem>
#include <utility>

#include <Eigen/Geometry>

#include "asperity/base/error.h"
#include "asperity/device/cap_scene.h"
#include "asperity/geometry/mesh_unit.h"
#include "asperity/scene/height_map_viewer.h"
#include "asperity/scene/read_scene.h"
#include "asperity/scene/set_mesh_unit.h"
#include "asperity/texture/read_height_image.h"

namespace asperity {

namespace fs = std::filesystem;

namespace {

// Images as tiles of a plane (seed Fig. 38), by Basdogan's model unless another is asked for.
Scene read_height_maps(SceneInput& input, FeelSettings& settings) {
  ReadHeightImageConfig image;
  HeightMapViewerConfig viewer;
  viewer.tile_mm = input.tile_mm;
  image.width_mm = input.tile_mm;
  image.range_mm = input.height_range_mm;
  viewer.stiffness_N_per_m = settings.render.stiffness_N_per_m;
  viewer.friction = settings.render.friction;
  if (settings.render.texture.model == TextureForceModel::kAuto) {
    settings.render.texture.model = TextureForceModel::kNormalPerturbation;
  }
  input.tile_stroke_m = viewer_stroke_m(input.height_maps.size(), viewer);
  std::vector<Texture> tiles;
  tiles.reserve(input.height_maps.size());
  Problems converted;
  for (const std::string& file : input.height_maps) tiles.push_back(read_height_image(file, image, &converted));
  Scene scene = make_height_map_viewer(tiles, viewer);
  scene.problems.insert(scene.problems.end(), converted.begin(), converted.end());
  return scene;
}

// Puts the middle of the workspace (the device's origin where that is not known) into the middle of the scene.
void place_device(const RenderModel& model, const DeviceInfo& info, DeviceFrame& frame) {
  Eigen::AlignedBox3d box;
  for (const RenderObject& object : model.objects) {
    for (const Eigen::Vector3d& vertex_m : object.mesh.vertices_m) box.extend(object.T_world_mesh * vertex_m);
  }
  const Eigen::Vector3d middle_m = 0.5 * (info.workspace_min_m + info.workspace_max_m);
  frame.translation_m =
      box.center() - (middle_m.allFinite() ? frame.position_m(middle_m) : Eigen::Vector3d(Eigen::Vector3d::Zero()));
}

}  // namespace

Scene read_scene_input(SceneInput& input, FeelSettings& settings, const Observer& observer) {
  if (!input.height_maps.empty()) return read_height_maps(input, settings);
  fs::path path(input.scene);
  if (fs::is_directory(path)) path /= "scene.json";
  Scene scene = read_scene(path, observer);
  if (input.mesh_unit_m) {
    set_mesh_unit(scene, path, *input.mesh_unit_m);
  } else {
    refuse_unlikely_metres(scene.objects.front().mesh, path);
  }
  return scene;
}

PreparedModel prepare_render_model(const Scene& scene, const DeviceInfo& device, bool driven, FeelSettings& settings) {
  PreparedModel out;
  const RenderConfig config = settings.render_config();
  if (driven) {
    out.model = std::make_unique<const RenderModel>(make_render_model(scene, config));
    return out;
  }
  const DeviceCaps caps = find_device_caps(device, settings.servo, settings.caps);
  CappedScene capped = cap_scene(scene, config, caps);
  out.model = std::make_unique<const RenderModel>(make_render_model(capped.scene, capped.config));
  out.warnings = std::move(capped.warnings);
  if (settings.servo.frame.translation_m.isZero(0.0)) place_device(*out.model, device, settings.servo.frame);
  return out;
}

}  // namespace asperity
