#include "study/trial_scene.h"

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "feel/feel_devices.h"

namespace asperity::studio {

FeelSetup study_setup(const Study& study, const FeelConfig& start) {
  FeelSetup out;
  out.config = start;
  out.device = feel_device_kind(study.presentation.device).name;
  apply_presentation(study, out.config.feel);
  // The modelled hand, and what it drives, stroke over the tiles from left to right.
  out.input.tile_stroke_m = trial_stroke_m(study);
  return out;
}

BlockWriter make_trial_block(const Study& study) {
  const std::size_t tiles = tiles_of(study);
  const Scene scene = make_blank_trial_scene(study);
  const MeshFile& mesh = scene.objects.front().mesh;
  std::vector<float> vertices_m;
  std::vector<std::uint32_t> triangles;
  std::vector<std::int32_t> texture;
  for (const Eigen::Vector3d& vertex_m : mesh.vertices) {
    for (int axis = 0; axis < 3; ++axis) vertices_m.push_back(static_cast<float>(vertex_m[axis]));
  }
  for (std::size_t k = 0; k < mesh.triangles.size(); ++k) {
    for (const auto corner : mesh.triangles[k]) triangles.push_back(static_cast<std::uint32_t>(corner));
    texture.push_back(mesh.haptic[k].texture > 0 ? mesh.haptic[k].texture - 1 : -1);
  }
  BlockWriter block("study.tiles");
  block.head()["objects"] = 1;
  block.head()["indices"] = Json::array();
  Json heads = Json::array();
  for (std::size_t k = 0; k < tiles; ++k) {
    Json head;
    head["name"] = k == 0 ? "A" : "B";
    for (const char* nothing : {"highest_m", "x0_m", "y0_m", "width_m", "height_m"}) head[nothing] = 0.0;
    heads.push_back(std::move(head));
  }
  block.head()["textures"] = std::move(heads);
  block.add("vertices_0", std::span<const float>(vertices_m), {mesh.vertices.size(), 3});
  block.add("triangles_0", std::span<const std::uint32_t>(triangles), {mesh.triangles.size(), 3});
  block.add("texture_0", std::span<const std::int32_t>(texture));
  return block;
}

}  // namespace asperity::studio
