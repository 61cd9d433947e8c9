#include "study/trial_scene.h"

#include <array>
#include <utility>

#include "asperity/base/error.h"
#include "asperity/base/text.h"
#include "asperity/scene/height_map_viewer.h"
#include "asperity/texture/texture_operations.h"
#include "feel/feel_devices.h"
#include "study/stimuli.h"

namespace asperity::studio {

namespace {

constexpr std::array<const char*, 2> kLabels{"A", "B"};
// It has no perceptible height; it stays a texture, so that its own stiffness and friction stay.
constexpr double kFlat = 1e-9;

HeightMapViewerConfig viewer_of(const Study& study) {
  HeightMapViewerConfig out;
  out.tile_mm = study.presentation.tile_mm;
  out.gap_mm = study.presentation.gap_mm;
  out.columns = study.method == StudyMethod::kRating ? 1 : 2;
  out.stiffness_N_per_m = study.presentation.stiffness_N_per_m;
  out.friction = study.presentation.friction;
  return out;
}

std::size_t tiles_of(const Study& study) { return study.method == StudyMethod::kRating ? 1 : 2; }

// One side of a staircase's trial.
void change_texture(Texture& texture, const Study& study, double level, bool comparison) {
  const double more = comparison ? 1.0 + level : 1.0;
  switch (study.parameter) {
    case StudyParameter::kHeight:
      return scale_texture(texture, comparison ? level : kFlat);
    case StudyParameter::kHeightDifference:
      return scale_texture(texture, more);
    case StudyParameter::kStiffnessDifference:
      texture.stiffness_N_per_m = more * texture.stiffness_N_per_m.value_or(study.presentation.stiffness_N_per_m);
      return;
    case StudyParameter::kFrictionDifference:
      texture.friction = more * texture.friction.value_or(study.presentation.friction);
      return;
  }
}

// The trial's tiles without textures: all trials of a study have this mesh.
Scene blank_scene(const Study& study) {
  Texture blank;
  Fourier1d flat;
  flat.a_m = flat.b_m = {0.0};
  blank.model = flat;
  return make_height_map_viewer(std::vector<Texture>(tiles_of(study), blank), viewer_of(study));
}

}  // namespace

void scale_texture(Texture& texture, double factor) {
  scale_texture_model(texture.model, factor);
  if (texture.height_offset_m) *texture.height_offset_m *= factor;
}

FeelSetup study_setup(const Study& study, const FeelConfig& start) {
  FeelSetup out;
  out.config = start;
  out.device = feel_device_kind(study.presentation.device).name;
  out.config.feel.render.stiffness_N_per_m = study.presentation.stiffness_N_per_m;
  out.config.feel.render.friction = study.presentation.friction;
  out.config.feel.render.texture.model = study.presentation.model;
  bool images = !study.stimuli.empty();
  for (const std::string& name : study.stimuli) images = images && is_image(name);
  if (images && study.presentation.model == TextureForceModel::kAuto) {
    out.config.feel.render.texture.model = TextureForceModel::kNormalPerturbation;
  }
  // The modelled hand, and what it drives, stroke over the tiles from left to right.
  out.input.tile_stroke_m = viewer_stroke_m(tiles_of(study), viewer_of(study));
  return out;
}

Scene make_trial_scene(const Study& study, const std::vector<Texture>& stimuli, const Trial& trial) {
  std::vector<Texture> tiles{stimuli.at(static_cast<std::size_t>(trial.left))};
  if (trial.right >= 0) tiles.push_back(stimuli.at(static_cast<std::size_t>(trial.right)));
  for (std::size_t k = 0; k < tiles.size(); ++k) {
    if (trial.level) change_texture(tiles[k], study, *trial.level, trial.comparison_right == (k == 1));
    tiles[k].name = kLabels.at(k);
  }
  return make_height_map_viewer(tiles, viewer_of(study));
}

std::vector<int> tile_of_triangle(const Study& study) {
  const MeshFile mesh = blank_scene(study).objects.front().mesh;
  std::vector<int> out;
  for (std::size_t k = 0; k < mesh.triangles.size(); ++k) {
    out.push_back(mesh.haptic[k].texture > 0 ? static_cast<int>(mesh.haptic[k].texture) - 1 : -1);
  }
  return out;
}

BlockWriter make_trial_block(const Study& study) {
  const std::size_t tiles = tiles_of(study);
  const Scene scene = blank_scene(study);
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
    head["name"] = kLabels.at(k);
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
