// Exchanging textures and models under a moving tip does not click; nothing of the step is allocated.
#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "asperity/base/error.h"
#include "asperity/base/random.h"
#include "asperity/render/texture_force.h"
#include "asperity/testkit/count_allocations.h"
#include "asperity/texture/autoregressive_filter.h"
#include "asperity/texture/synthesize_isotropic.h"

namespace asperity {
namespace {

Texture rough(double amplitude_m, std::uint64_t seed) {
  Random random(seed);
  Fourier1d f{10.0, {}, {}, 0.0};
  for (int j = 1; j <= 16; ++j) {
    f.a_m.push_back(amplitude_m * random.normal() / j);
    f.b_m.push_back(amplitude_m * random.normal() / j);
  }
  Texture texture;
  texture.model = f;
  return texture;
}

Texture vibration() {
  AutoregressiveTexture t;
  t.models.push_back({0.1, 1.0, reflection_to_lsf(std::vector<double>{-0.5, 0.3}), {}, 1.0, 1.0});
  prepare_autoregressive(t, "test");
  Texture texture;
  texture.model = t;
  return texture;
}

std::vector<RenderTexture> all_models() {
  const Texture height = rough(4e-5, 1);
  std::vector<RenderTexture> textures{make_render_texture(height, {}),
                                      make_render_texture(height, {.model = TextureForceModel::kNormalPerturbation}),
                                      make_render_texture(height, {.model = TextureForceModel::kLateralGradient}),
                                      make_render_texture(height, {.model = kForceModelOf<StochasticTexture>}),
                                      make_render_texture(rough(8e-5, 2), {}),
                                      make_render_texture(vibration(), {})};
  Texture taps;
  taps.model = DecayingSinusoids{.a_per_s = 100.0, .mass_kg = 0.05, .pitch_m = 1e-3};
  textures.push_back(make_render_texture(taps, {}));
  return textures;
}

TextureTouch at(double x_m) {
  TextureTouch touch;
  touch.x_m = x_m;
  touch.x_gradient = Eigen::Vector3d::UnitX();
  touch.y_gradient = Eigen::Vector3d::UnitY();
  touch.z_m = -5e-4;
  touch.stiffness_N_per_m = 1000.0;
  touch.contact_N = 0.5;
  touch.v_tangential_mps = Eigen::Vector3d(0.05, 0.0, 0.0);
  return touch;
}

// The forces of a second of stroking; `which` gives the texture of a step, null for none.
template <class Which>
std::vector<Eigen::Vector3d> stroked(const Which& which) {
  TextureState state;
  std::vector<Eigen::Vector3d> forces;
  for (int i = 0; i < 1000; ++i) {
    const RenderTexture* texture = which(i);
    forces.push_back(
        (texture == nullptr ? no_texture_force(state, true, 1e-3) : texture_force(*texture, state, at(5e-5 * i)))
            .force_N);
  }
  return forces;
}

double largest_step(const std::vector<Eigen::Vector3d>& forces) {
  double step = 0.0;
  for (std::size_t i = 1; i < forces.size(); ++i) step = std::max(step, (forces[i] - forces[i - 1]).norm());
  return step;
}

TEST(TextureChange, HasAnIdOfItsOwnForEveryTextureAndModel) {
  const auto textures = all_models();
  for (std::size_t i = 0; i < textures.size(); ++i) {
    EXPECT_NE(textures[i].id, 0u);
    for (std::size_t j = 0; j < i; ++j) EXPECT_NE(textures[i].id, textures[j].id) << i << ' ' << j;
  }
  EXPECT_EQ(make_render_texture(rough(4e-5, 1), {}).id, textures[0].id) << "over snapshots too";
}

// A difference D fades within 0.05 s by at most 1.5 D · 1 ms / 50 ms a step; that is the allowance.
TEST(TextureChange, DoesNotClick) {
  auto textures = all_models();
  std::vector<const RenderTexture*> kinds{nullptr};
  for (const RenderTexture& texture : textures) kinds.push_back(&texture);
  for (const RenderTexture* from : kinds) {
    for (const RenderTexture* to : kinds) {
      const auto before = stroked([&](int) { return from; });
      const auto after = stroked([&](int) { return to; });
      const auto changed = stroked([&](int i) { return i < 500 ? from : to; });
      double most = 0.0;
      for (const auto& f : before) most = std::max(most, f.norm());
      for (const auto& f : after) most = std::max(most, f.norm());
      const double allowed = std::max(largest_step(before), largest_step(after)) + 2.0 * most * 1.5 / 50.0;
      EXPECT_LE(largest_step(changed), 1.05 * allowed);
    }
  }
}

TEST(TextureChange, EndsWithTheNewTexturesForce) {
  const auto textures = all_models();
  const auto changed = stroked([&](int i) { return i < 500 ? &textures[0] : &textures[4]; });
  const auto after = stroked([&](int) { return &textures[4]; });
  EXPECT_EQ(changed[499], stroked([&](int) { return &textures[0]; })[499]);
  for (std::size_t i = 552; i < 1000; ++i) EXPECT_EQ(changed[i], after[i]) << i;
}

TEST(TextureChange, OfATouchFromTheAirDoesNotFade) {
  const auto textures = all_models();
  TextureState state;
  no_texture_force(state, false, 1e-3);
  TextureState fresh;
  EXPECT_EQ(texture_force(textures[0], state, at(1e-3)).force_N, texture_force(textures[0], fresh, at(1e-3)).force_N);
  EXPECT_GT(state.last_force_N.norm(), 0.0);
  EXPECT_EQ(no_texture_force(state, false, 1e-3).force_N, Eigen::Vector3d::Zero()) << "the air bears nothing";
}

TEST(TextureChange, AllocatesNothing) {
  auto textures = all_models();
  Fourier2d isotropic;
  isotropic.kind = Fourier2dKind::kIsotropic;
  isotropic.isotropic.power_m2.assign(8, 1e-12);
  isotropic.grid = synthesize_isotropic(isotropic.isotropic);
  Texture grid;
  grid.model = isotropic;
  textures.push_back(make_render_texture(grid, {}));
  TextureState state;
  Random random(3);
  const std::size_t before = testkit::count_allocations();
  ::operator delete(::operator new(1));
  ASSERT_GT(testkit::count_allocations(), before) << "the counter counts";
  const std::size_t start = testkit::count_allocations();
  double sum = 0.0;
  for (int i = 0; i < 20000; ++i) {
    TextureTouch touch = at(random.uniform(-1.0, 1.0));
    touch.y_m = random.uniform(-1.0, 1.0);
    touch.contact_N = random.uniform(-0.2, 1.0);
    touch.approach_mps = 0.1;
    sum += texture_force(textures[static_cast<std::size_t>(i / 50) % textures.size()], state, touch).force_N.norm();
    if (i % 37 == 0) sum += no_texture_force(state, i % 2 == 0, 1e-3).force_N.norm();
  }
  EXPECT_EQ(testkit::count_allocations(), start);
  EXPECT_TRUE(std::isfinite(sum));
}

TEST(RenderTexture, IsFilteredToTheCutoff) {
  Texture texture;
  texture.model = Fourier1d{10.0, {1e-4, 0.0, 0.0, 0.0, 0.0, 0.0, 1e-4}, {0, 0, 0, 0, 0, 0, 0}, 0.0};
  RenderTextureConfig config;
  config.cutoff_cycles_per_mm = 0.4;
  const RenderTexture rendered = make_render_texture(texture, config);
  EXPECT_EQ(std::get<Fourier1d>(rendered.texture.model).a_m.size(), 3u);
  EXPECT_NEAR(rendered.highest_m, 2e-4, 1e-12);
  EXPECT_NE(rendered.id, make_render_texture(texture, {}).id);
  config.cutoff_cycles_per_mm = -1.0;
  EXPECT_THROW(make_render_texture(texture, config), Error);
}

}  // namespace
}  // namespace asperity
