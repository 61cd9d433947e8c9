// A texture model is its own files and its entry in texture_models.h: with the entry, and nothing else, files,
// settings, fits, studies and the renderer have it.
#include <algorithm>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "asperity/base/config.h"
#include "asperity/render/texture_force.h"
#include "asperity/texture/evaluate_height.h"
#include "asperity/texture/low_pass_texture.h"
#include "asperity/texture/sample_heights.h"
#include "asperity/texture/synthesize_stroke.h"
#include "asperity/texture/texture_file.h"
#include "asperity/texture/texture_fit.h"
#include "asperity/texture/texture_operations.h"

namespace asperity {
namespace {

using testing::Contains;
using testing::HasSubstr;

Texture wave() {
  Texture texture;
  texture.model = TriangleWave{2.0, 1e-4};
  return texture;
}

TEST(AddedTextureModel, IsWrittenAndRead) {
  const std::string text = format_texture(wave());
  EXPECT_THAT(text, HasSubstr("\"model\": \"triangle_wave\""));
  const Texture read = parse_texture(text, "wave.texture.json");
  EXPECT_EQ(std::get<TriangleWave>(read.model).height_m, 1e-4);
  EXPECT_EQ(format_texture(read), text);
  EXPECT_THROW(
      parse_texture(R"({"format":"asperity-texture","version":1,"model":"square_wave","square_wave":{}})", "x"), Error);
}

TEST(AddedTextureModel, IsAHeightField) {
  const TextureModel model = wave().model;
  EXPECT_TRUE(is_height_field(model));
  EXPECT_DOUBLE_EQ(evaluate_height(model, 0.5e-3, 0.7).height_m, 0.5e-4);
  EXPECT_EQ(lowest_height_m(model), 0.0);
  EXPECT_EQ(highest_height_m(model), 1e-4);
  EXPECT_EQ(period_m(model), 2e-3);
  EXPECT_EQ(sample_lines(model, 0.01, 1e-4).size(), 1u);
  EXPECT_EQ(low_pass_texture(wave(), 10.0).model_name(), "triangle_wave");
  EXPECT_EQ(describe_texture_model(model).size(), 2u);
}

TEST(AddedTextureModel, IsFitted) {
  EXPECT_THAT(kFittedModelNames, Contains("triangle_wave"));
  TextureFitOptions options;
  FittedModelChoice choice{};
  ConfigLister lister;
  lister.choice("model", choice, kFittedModelNames, "");
  options.visit(lister);
  const auto fields = lister.take();
  set_field(fields, "model", "triangle_wave");
  set_field(fields, "triangle_wave.length_mm", "3");
  TextureFitInput input;
  input.files = {"heights"};
  input.read_heights = [](const auto&) { return HeightLine{{1e-4, 3e-4, 2e-4}, 1e-4}; };
  const FittedTexture fitted = fit_texture(choice, input, options);
  EXPECT_EQ(std::get<TriangleWave>(fitted.texture.model).length_mm, 3.0);
  EXPECT_DOUBLE_EQ(std::get<TriangleWave>(fitted.texture.model).height_m, 2e-4);
}

TEST(AddedTextureModel, IsAStimulus) {
  TextureModel model = wave().model;
  scale_texture_model(model, 0.5);
  EXPECT_EQ(highest_height_m(model), 0.5e-4);
  EXPECT_FALSE(reseed_texture_model(model, 7));
}

TEST(AddedTextureModel, IsRenderedAndHasAStroke) {
  const RenderTexture texture = make_render_texture(wave(), {});
  EXPECT_DOUBLE_EQ(texture.highest_m, 1e-4);
  TextureState state;
  TextureTouch touch;
  touch.x_m = 0.5e-3;
  touch.contact_N = 1.0;
  touch.stiffness_N_per_m = 1000.0;
  // k H along the normal, wholly pressed in.
  EXPECT_DOUBLE_EQ(texture_force(texture, state, touch).force_N.z(), 1000.0 * 0.5e-4);
  EXPECT_NO_THROW(make_render_texture(wave(), {.model = kForceModelOf<StochasticTexture>}));
  const std::vector<double> stroke = synthesize_stroke(wave(), {.duration_s = 0.1});
  EXPECT_GT(*std::max_element(stroke.begin(), stroke.end()), 0.0);
}

}  // namespace
}  // namespace asperity
