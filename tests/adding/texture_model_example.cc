// A texture model, as docs/architecture.md tells to add one. Its line in texture_models.h is in CMakeLists.txt here.
#include <gmock/gmock.h>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "asperity/base/config.h"
#include "asperity/base/error.h"
#include "asperity/render/render_model.h"
#include "asperity/render/render_step.h"
#include "asperity/scene/scene.h"
#include "asperity/texture/evaluate_height.h"
#include "asperity/texture/named_values.h"
#include "asperity/texture/texture_file.h"
#include "asperity/texture/texture_fit.h"
#include "asperity/texture/texture_hash.h"
#include "flat_block.h"

namespace asperity {
namespace {

// modules/texture/src/ridges_model.cc --------------------------------------------------------------------------------

using Traits = TextureModelTraits<Ridges>;

template <class Model, class Field>
void list(Model& r, const Field& field) {
  field("pitch_m", r.pitch_m, 1e-6, 1.0);
  field("height_m", r.height_m, 0.0, 1.0);
}

}  // namespace

void Traits::read_block(const BlockInput& input, Ridges& r) {
  input.json.only(input.path, {"pitch_m", "height_m"});
  list(r, FlatReader{input});
}

std::string Traits::write_block(const Ridges& r, BlockOutput&) {
  BlockText block;
  list(r, FlatWriter{block});
  return block.str();
}

NamedValues Traits::describe(const Ridges& r) {
  return NamedValues().add("pitch_m", r.pitch_m).add("height_m", r.height_m);
}

void Traits::add_to(TextureHash& hash, const Ridges& r) { hash.add(r.pitch_m, r.height_m); }

HeightAndGradient Traits::height(const Ridges& r, double x_m, double) noexcept {
  const double rate = 2.0 * std::numbers::pi / r.pitch_m;
  return {0.5 * r.height_m * (1.0 - std::cos(rate * x_m)), 0.5 * r.height_m * rate * std::sin(rate * x_m), 0.0};
}

HeightWindow Traits::window(const Ridges& r, std::size_t most_cells) {
  return {0.0, 0.0, r.pitch_m, r.pitch_m, std::min<std::size_t>(16, most_cells), 1};
}

void Traits::fit(const TextureFitInput& input, const TextureFitOptions& options, FittedTexture& out) {
  const HeightLine line = input.read_heights(input.files);
  const auto [lowest, highest] = std::minmax_element(line.height_m.begin(), line.height_m.end());
  const Ridges ridges{1e-3 * options.of<Ridges>().ridges.pitch_mm, *highest - *lowest};
  out.texture.model = ridges;
  out.report = describe(ridges);
}

namespace {

// --------------------------------------------------------------------------------------------------------------------

constexpr double kPitch_m = 4e-3;
constexpr double kHeight_m = 0.2e-3;

Texture ridges() {
  Texture texture;
  texture.name = "ridges";
  texture.model = Ridges{kPitch_m, kHeight_m};
  return texture;
}

TEST(AddingATextureModel, ItsFileIsWrittenAndReadAgain) {
  const std::string text = format_texture(ridges());
  const Texture back = parse_texture(text, "ridges.texture.json");
  EXPECT_EQ(back.model_name(), "ridges");
  EXPECT_EQ(std::get<Ridges>(back.model).pitch_m, kPitch_m);
  EXPECT_EQ(format_texture(back), text);
  EXPECT_THROW(parse_texture(R"({"format":"asperity-texture","version":1,"model":"ridges","ridges":{"depth":1}})", "x"),
               Error);
}

TEST(AddingATextureModel, ItIsEvaluatedAsAHeightField) {
  EXPECT_NEAR(evaluate_height(ridges().model, 0.5 * kPitch_m, 0.0).height_m, kHeight_m, 1e-15);
  EXPECT_NEAR(evaluate_height(ridges().model, 3.25 * kPitch_m, 0.0).height_m, 0.5 * kHeight_m, 1e-15);
}

TEST(AddingATextureModel, ItIsFittedByTheNameThatTheCommandLineHas) {
  const auto found = std::find(kFittedModelNames.begin(), kFittedModelNames.end(), "ridges");
  ASSERT_NE(found, kFittedModelNames.end());
  TextureFitOptions options;
  set_field(list_fields("", options), "ridges.pitch_mm", "3");
  TextureFitInput input;
  input.files = {"heights"};
  input.read_heights = [](const std::vector<std::string>&) { return HeightLine{{0.0, 1e-4, 3e-4, 2e-4}, 1e-4}; };
  const FittedTexture fitted =
      fit_texture(static_cast<FittedModelChoice>(found - kFittedModelNames.begin()), input, options);
  EXPECT_NEAR(std::get<Ridges>(fitted.texture.model).pitch_m, 3e-3, 1e-15);
  EXPECT_NEAR(std::get<Ridges>(fitted.texture.model).height_m, 3e-4, 1e-15);
}

// A plate of 20 mm, x along the scan path.
Scene plate() {
  SceneObject object;
  object.mesh_file = "plate.obj";
  object.mesh.vertices = {{0.0, 0.0, 0.0}, {0.02, 0.0, 0.0}, {0.02, 0.02, 0.0}, {0.0, 0.02, 0.0}};
  object.mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  object.mesh.haptic = {{1, {Eigen::Vector2d(0, 0), Eigen::Vector2d(20, 0), Eigen::Vector2d(20, 20)}},
                        {1, {Eigen::Vector2d(0, 0), Eigen::Vector2d(20, 20), Eigen::Vector2d(0, 20)}}};
  object.textures = {{1, "ridges.texture.json", ridges()}};
  Scene scene;
  scene.objects.push_back(std::move(object));
  return scene;
}

TEST(AddingATextureModel, ItIsRendered) {
  const RenderModel model = make_render_model(plate(), {});
  ServoState state;
  ServoOutput out;
  // Down onto the plate half a pitch beyond two whole ones: on top of a ridge.
  for (int k = 0; k <= 200; ++k) {
    DeviceState device;
    device.p_world_m = {2.5 * kPitch_m, 0.01, 1e-3 - 1e-5 * k};
    out = render_step(model, state, device);
  }
  EXPECT_NEAR(out.texture_height_m, kHeight_m, 1e-3 * kHeight_m);
  EXPECT_GT(out.texture_N.z(), 0.0);
}

}  // namespace
}  // namespace asperity
