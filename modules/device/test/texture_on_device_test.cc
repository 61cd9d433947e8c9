// Loop gains worked out by hand.
#include "asperity/device/texture_on_device.h"

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

TEST(TextureOnDevice, MeasuresHowMuchATextureStiffensTheLoop) {
  constexpr double kAmplitude_m = 1e-4;
  const double omega_per_m = 2.0 * std::numbers::pi / 2e-3;
  const double s = kAmplitude_m * omega_per_m;
  const double c = s * omega_per_m;
  DeviceCaps device;
  device.stiffness_N_per_m = 2.0 * 0.5 * 1000.0;  // of a damping of 0.5 N s/m at 1 kHz
  const Texture texture = sine(kAmplitude_m, 2.0);
  const TextureOnDevice height = check_texture_on_device(make_render_texture(texture, {}), 1000.0, 0.4, device);
  EXPECT_NEAR(height.steepest, s, 1e-4 * s);
  EXPECT_NEAR(height.most_curved_per_m, c, 1e-3 * c);
  EXPECT_NEAR(height.loop_gain, std::sqrt(1.0 + s * s), 1e-4);
  EXPECT_NEAR(height.highest_stiffness_N_per_m, 2.0 * 0.5 * 1000.0 / std::sqrt(1.0 + s * s), 0.1);
  EXPECT_NEAR(height.most_force_N, 0.4 * 1000.0 * 2.0 * kAmplitude_m, 1e-6);
  EXPECT_THAT(height.problems, Contains(Field(&Problem::kind, "texture_loop_gain")));

  const RenderTexture perturbed = make_render_texture(texture, {.model = TextureForceModel::kNormalPerturbation});
  EXPECT_NEAR(check_texture_on_device(perturbed, 1000.0, 0.4, device).loop_gain,
              std::sqrt(1.0 + s * s) + 2.0 * kAmplitude_m * c, 2e-3);
}

TEST(TextureOnDevice, RefusesAStiffnessThatIsNotPositive) {
  const RenderTexture texture = make_render_texture(sine(1e-4, 2.0), {});
  for (const double wrong : {0.0, -5.0, std::nan("")})
    EXPECT_THROW(check_texture_on_device(texture, wrong, 1.0, DeviceCaps{}), Error);
}

// Steps of 1 mm in 0.1 mm, 20 mm away from the origin of an image of 50 mm.
TEST(TextureOnDevice, MeasuresAllOfAnImage) {
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
  const TextureOnDevice fit = check_texture_on_device(make_render_texture(texture, {}), 400.0, 1.0, DeviceCaps{});
  EXPECT_GT(fit.steepest, 5.0);
  EXPECT_GT(fit.loop_gain, 5.0);
}

TEST(TextureOnDevice, WarnsInWords) {
  DeviceCaps device;
  device.force_N = 0.1;
  device.texture_stiffness_N_per_m = 450.0;
  device.texture_cycles_per_mm = 2.5;
  const TextureOnDevice fit = check_texture_on_device(make_render_texture(sine(2e-4, 0.2), {}), 1000.0, 1.0, device);
  EXPECT_THAT(fit.problems, Contains(Field(&Problem::kind, "texture_stiffness")));
  EXPECT_THAT(fit.problems, Contains(Field(&Problem::kind, "texture_force")));
  EXPECT_THAT(fit.problems, Contains(Field(&Problem::kind, "texture_bandwidth")));
  EXPECT_EQ(fit.highest_stiffness_N_per_m, DeviceCaps::kNone);
  EXPECT_THAT(check_texture_on_device(make_render_texture(sine(1e-5, 5.0), {}), 400.0, 1.0, device).problems,
              IsEmpty());
}

}  // namespace
}  // namespace asperity
