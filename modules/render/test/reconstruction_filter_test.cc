// Cut-offs and loop gains worked out by hand.
#include "asperity/render/reconstruction_filter.h"

#include <cmath>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "asperity/base/error.h"

namespace asperity {
namespace {

using testing::Contains;
using testing::Field;
using testing::IsEmpty;

Texture sine(double amplitude_m, double length_mm) {
  Texture texture;
  texture.model = Fourier1d{length_mm, {0.0}, {amplitude_m}, 0.0};
  return texture;
}

TEST(ReconstructionFilter, CutsOffWhereTheDeviceDoes) {
  TextureDevice device;
  device.highest_speed_mps = 0.1;
  EXPECT_DOUBLE_EQ(reconstruction_cutoff_cycles_per_mm(device), 2.5) << "a quarter of 1 kHz at 100 mm/s";
  device.bandwidth_Hz = 30.0;  // the Phantom's first anti-resonance (seed §2.1)
  EXPECT_DOUBLE_EQ(reconstruction_cutoff_cycles_per_mm(device), 0.3);
  device.bandwidth_Hz = 400.0;  // the Pantograph's
  device.rate_Hz = 4000.0;
  EXPECT_DOUBLE_EQ(reconstruction_cutoff_cycles_per_mm(device), 4.0);
  device.position_resolution_m = 1e-4;
  EXPECT_DOUBLE_EQ(reconstruction_cutoff_cycles_per_mm(device), 2.5);
  device.highest_speed_mps = 0.0;
  EXPECT_THROW(reconstruction_cutoff_cycles_per_mm(device), Error);
}

TEST(ReconstructionFilter, FiltersWhatIsRendered) {
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

TEST(ReconstructionFilter, MeasuresHowMuchATextureStiffensTheLoop) {
  constexpr double kAmplitude_m = 1e-4;
  const double omega_per_m = 2.0 * std::numbers::pi / 2e-3;
  const double s = kAmplitude_m * omega_per_m;
  const double c = s * omega_per_m;
  TextureDevice device;
  device.damping_N_s_per_m = 0.5;
  const Texture texture = sine(kAmplitude_m, 2.0);
  const TextureFit height = fit_texture_to_device(make_render_texture(texture, {}), 1000.0, 0.4, device);
  EXPECT_NEAR(height.steepest, s, 1e-4 * s);
  EXPECT_NEAR(height.most_curved_per_m, c, 1e-3 * c);
  EXPECT_NEAR(height.loop_gain, std::sqrt(1.0 + s * s), 1e-4);
  EXPECT_NEAR(height.highest_stiffness_N_per_m, 2.0 * 0.5 * 1000.0 / std::sqrt(1.0 + s * s), 0.1);
  EXPECT_NEAR(height.most_force_N, 0.4 * 1000.0 * 2.0 * kAmplitude_m, 1e-6);
  EXPECT_THAT(height.problems, Contains(Field(&Problem::kind, "texture_damping")));

  const RenderTexture perturbed = make_render_texture(texture, {.model = TextureForceModel::kNormalPerturbation});
  EXPECT_NEAR(fit_texture_to_device(perturbed, 1000.0, 0.4, device).loop_gain,
              std::sqrt(1.0 + s * s) + 2.0 * kAmplitude_m * c, 2e-3);
}

TEST(ReconstructionFilter, RefusesABandwidthOrAResolutionThatIsNotPositive) {
  for (const double wrong : {0.0, -5.0}) {
    TextureDevice device;
    device.bandwidth_Hz = wrong;
    EXPECT_THROW(reconstruction_cutoff_cycles_per_mm(device), Error);
    device = {};
    device.position_resolution_m = wrong;
    EXPECT_THROW(reconstruction_cutoff_cycles_per_mm(device), Error);
  }
}

// Steps of 1 mm in 0.1 mm, 20 mm away from the origin of an image of 50 mm.
TEST(ReconstructionFilter, MeasuresAllOfAnImage) {
  HeightMap map;
  map.columns = map.rows = 500;
  map.mm_per_px_x = map.mm_per_px_y = 0.1;
  map.high_m = 1e-3;
  map.bits = 8;
  map.border = Border::kMirror;
  map.level.assign(map.columns * map.rows, 0);
  for (std::size_t r = 200; r < 300; ++r)
    for (std::size_t c = 200; c < 300; ++c) map.level[r * map.columns + c] = (c / 3) % 2 == 0 ? 255 : 0;
  Texture texture;
  texture.model = map;
  const TextureFit fit = fit_texture_to_device(make_render_texture(texture, {}), 400.0, 1.0, {});
  EXPECT_GT(fit.steepest, 5.0);
  EXPECT_GT(fit.loop_gain, 5.0);
}

TEST(ReconstructionFilter, WarnsInWords) {
  TextureDevice device;
  device.max_force_N = 0.1;
  const TextureFit fit = fit_texture_to_device(make_render_texture(sine(2e-4, 0.2), {}), 1000.0, 1.0, device);
  EXPECT_THAT(fit.problems, Contains(Field(&Problem::kind, "texture_stiffness")));
  EXPECT_THAT(fit.problems, Contains(Field(&Problem::kind, "texture_force")));
  EXPECT_THAT(fit.problems, Contains(Field(&Problem::kind, "texture_bandwidth")));
  EXPECT_TRUE(std::isnan(fit.highest_stiffness_N_per_m));
  EXPECT_THAT(fit_texture_to_device(make_render_texture(sine(1e-5, 5.0), {}), 400.0, 1.0, device).problems, IsEmpty());
}

}  // namespace
}  // namespace asperity
