#include "asperity/session/study_scene.h"

#include <utility>

#include "asperity/scene/height_map_viewer.h"
#include "asperity/session/study_stimuli.h"
#include "asperity/texture/texture_operations.h"

namespace asperity {

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

}  // namespace

std::size_t tiles_of(const Study& study) { return study.method == StudyMethod::kRating ? 1 : 2; }

Scene make_blank_trial_scene(const Study& study) {
  Texture blank;
  Fourier1d flat;
  flat.a_m = flat.b_m = {0.0};
  blank.model = flat;
  return make_height_map_viewer(std::vector<Texture>(tiles_of(study), blank), viewer_of(study));
}

void scale_texture(Texture& texture, double factor) {
  scale_texture_model(texture.model, factor);
  if (texture.height_offset_m) *texture.height_offset_m *= factor;
}

std::array<Eigen::Vector3d, 2> trial_stroke_m(const Study& study) {
  return viewer_stroke_m(tiles_of(study), viewer_of(study));
}

void apply_presentation(const Study& study, FeelSettings& settings) {
  settings.render.stiffness_N_per_m = study.presentation.stiffness_N_per_m;
  settings.render.friction = study.presentation.friction;
  settings.render.texture.model = study.presentation.model;
  bool images = !study.stimuli.empty();
  for (const std::string& name : study.stimuli) images = images && is_image(name);
  if (images && study.presentation.model == TextureForceModel::kAuto)
    settings.render.texture.model = TextureForceModel::kNormalPerturbation;
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
  const MeshFile mesh = make_blank_trial_scene(study).objects.front().mesh;
  std::vector<int> out;
  for (std::size_t k = 0; k < mesh.triangles.size(); ++k) {
    out.push_back(mesh.haptic[k].texture > 0 ? static_cast<int>(mesh.haptic[k].texture) - 1 : -1);
  }
  return out;
}

}  // namespace asperity
