#include "study/trial_scene.h"

#include <cmath>

#include <gmock/gmock.h>

#include "asperity/base/error.h"
#include "asperity/render/render_model.h"
#include "asperity/texture/evaluate_height.h"

namespace asperity::studio {
namespace {

// A wave of 10 µm and 2 mm; a grey ramp of 0 to 100 µm.
std::vector<Texture> textures() {
  Texture wave;
  wave.model = Fourier1d{2.0, {0.0}, {1e-5}, 2e-5};
  HeightMap map;
  map.columns = map.rows = 4;
  map.mm_per_px_x = map.mm_per_px_y = 1.0;
  map.high_m = 1e-4;
  map.bits = 8;
  for (int k = 0; k < 16; ++k) map.level.push_back(static_cast<std::uint16_t>(16 * k));
  Texture ramp;
  ramp.model = map;
  return {wave, ramp};
}

Study study_of(StudyMethod method) {
  Study out;
  out.method = method;
  out.stimuli = {"a.texture.json", "b.png"};
  return out;
}

// The largest difference of heights of a tile, as it is rendered.
double span_m(const Scene& scene, std::size_t tile) {
  const RenderModel model = make_render_model(scene, RenderConfig());
  double low_m = 1.0, high_m = -1.0;
  for (int k = 0; k < 400; ++k) {
    const double height_m = render_height(model.textures.at(tile), 1e-5 * k, 0.7e-5 * k).height_m;
    low_m = std::min(low_m, height_m);
    high_m = std::max(high_m, height_m);
  }
  return high_m - low_m;
}

TEST(TrialScene, LaysTheTexturesSideBySideUnderTheirLetters) {
  Trial trial;
  trial.left = 1;
  trial.right = 0;
  const Scene scene = make_trial_scene(study_of(StudyMethod::kPairs), textures(), trial);
  ASSERT_EQ(scene.objects.front().textures.size(), 2U);
  EXPECT_EQ(scene.objects.front().textures[0].texture.name, "A");
  EXPECT_TRUE(std::holds_alternative<HeightMap>(scene.objects.front().textures[0].texture.model));
  EXPECT_TRUE(std::holds_alternative<Fourier1d>(scene.objects.front().textures[1].texture.model));
  // Texture 1, A, is at the smaller x.
  double left_m = 0.0, right_m = 0.0;
  const MeshFile& mesh = scene.objects.front().mesh;
  for (std::size_t k = 0; k < mesh.triangles.size(); ++k) {
    const double x_m = mesh.vertices[mesh.triangles[k][0]].x();
    if (mesh.haptic[k].texture == 1) left_m = x_m;
    if (mesh.haptic[k].texture == 2) right_m = x_m;
  }
  EXPECT_LT(left_m, right_m);
  trial.right = -1;
  EXPECT_EQ(make_trial_scene(study_of(StudyMethod::kRating), textures(), trial).objects.front().textures.size(), 1U);
}

TEST(TrialScene, ChangesOneSideByTheLevel) {
  Study study = study_of(StudyMethod::kStaircase);
  Trial trial;
  trial.left = trial.right = 0;
  trial.level = 0.5;
  trial.comparison_right = true;
  Scene scene = make_trial_scene(study, textures(), trial);
  // Twice the amplitude, up to the samples' distance from the crests.
  EXPECT_NEAR(span_m(scene, 0), 2e-5, 1e-8);
  EXPECT_NEAR(span_m(scene, 1), 3e-5, 1e-8);
  trial.comparison_right = false;
  study.parameter = StudyParameter::kHeight;
  scene = make_trial_scene(study, textures(), trial);
  EXPECT_NEAR(span_m(scene, 0), 1e-5, 1e-8);
  EXPECT_NEAR(span_m(scene, 1), 0.0, 1e-12);
  study.parameter = StudyParameter::kStiffnessDifference;
  scene = make_trial_scene(study, textures(), trial);
  EXPECT_EQ(scene.objects.front().textures[0].texture.stiffness_N_per_m, 1500.0);
  EXPECT_EQ(scene.objects.front().textures[1].texture.stiffness_N_per_m, 1000.0);
  study.parameter = StudyParameter::kFrictionDifference;
  study.presentation.friction = 0.2;
  scene = make_trial_scene(study, textures(), trial);
  EXPECT_DOUBLE_EQ(scene.objects.front().textures[0].texture.friction.value(), 0.3);
}

TEST(TrialScene, ScalesEveryModel) {
  for (const Texture& texture : textures()) {
    Texture scaled = texture;
    scale_texture(scaled, 3.0);
    for (const double x_m : {0.0, 3e-4, 1.1e-3}) {
      EXPECT_NEAR(evaluate_height(scaled.model, x_m, 1e-3).height_m,
                  3.0 * evaluate_height(texture.model, x_m, 1e-3).height_m, 1e-15);
    }
  }
  Texture noise;
  noise.model = StochasticTexture{};
  std::get<StochasticTexture>(noise.model).sigma_m = 2e-6;
  scale_texture(noise, 3.0);
  EXPECT_DOUBLE_EQ(std::get<StochasticTexture>(noise.model).sigma_m, 6e-6);
}

TEST(TrialScene, UsesTheViewersModelForImagesAlone) {
  Study study = study_of(StudyMethod::kPairs);
  EXPECT_EQ(study_setup(study, {}).config.feel.render.texture.model, TextureForceModel::kAuto);
  study.stimuli = {"a.png", "b.pgm"};
  EXPECT_EQ(study_setup(study, {}).config.feel.render.texture.model, TextureForceModel::kNormalPerturbation);
  study.presentation.model = TextureForceModel::kHeight;
  EXPECT_EQ(study_setup(study, {}).config.feel.render.texture.model, TextureForceModel::kHeight);
  study.presentation.device = "hammer";
  EXPECT_THROW(study_setup(study, {}), Error);
}

}  // namespace
}  // namespace asperity::studio
