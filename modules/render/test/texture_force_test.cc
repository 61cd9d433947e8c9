// The force models of height fields against their formulas, written out anew over a sine.
#include "asperity/render/texture_force.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <gtest/gtest.h>

#include "asperity/base/error.h"

namespace asperity {
namespace {

constexpr double kAmplitude_m = 2e-4;
constexpr double kLength_m = 5e-3;

// A sine of 0.2 mm about the mean, 5 mm long: with its offset, its heights are 0 to 0.4 mm.
Texture sine() {
  Texture texture;
  texture.model = Fourier1d{1e3 * kLength_m, {0.0}, {kAmplitude_m}, 0.0};
  return texture;
}

double height_m(double x_m) { return kAmplitude_m * (1.0 + std::sin(2.0 * std::numbers::pi * x_m / kLength_m)); }
double slope(double x_m) {
  const double omega = 2.0 * std::numbers::pi / kLength_m;
  return kAmplitude_m * omega * std::cos(omega * x_m);
}

TextureTouch touch_at(double x_m, double z_m) {
  TextureTouch touch;
  touch.x_m = x_m;
  touch.x_gradient = Eigen::Vector3d::UnitX();
  touch.y_gradient = Eigen::Vector3d::UnitY();
  touch.z_m = z_m;
  touch.stiffness_N_per_m = 800.0;
  touch.contact_N = 800.0 * std::max(-z_m, 0.0);
  touch.compliance_kc = 0.7;
  return touch;
}

Eigen::Vector3d force_N(const RenderTexture& texture, const TextureTouch& touch) {
  TextureState state;
  return texture_force(texture, state, touch).force_N;
}

// Of forces of 0.3 N: an error of heights and slopes of 1e-6 and 1e-4 of their RMS.
constexpr double kForceTol_N = 1e-5;

// Every place and depth of interest, in the air and deep inside.
template <class Check>
void at_all_places(const Check& check) {
  for (double x_m = -0.02; x_m < 0.02; x_m += 0.00037) {
    for (double z_m = -1e-3; z_m < 1e-3; z_m += 5e-5) check(x_m, z_m);
  }
}

double depth_m(double x_m, double z_m) { return std::clamp(height_m(x_m) - z_m, 0.0, height_m(x_m)); }

TEST(TextureForce, OfAHeightIsItsDepthTimesTheStiffness) {
  const RenderTexture texture = make_render_texture(sine(), {});
  EXPECT_EQ(texture.model, TextureForceModel::kHeight);
  EXPECT_NEAR(texture.height_offset_m, kAmplitude_m, 1e-12);
  EXPECT_NEAR(texture.highest_m, 2.0 * kAmplitude_m, 1e-12);
  at_all_places([&](double x_m, double z_m) {
    const Eigen::Vector3d expected(0.0, 0.0, 0.7 * 800.0 * depth_m(x_m, z_m));
    EXPECT_NEAR((force_N(texture, touch_at(x_m, z_m)) - expected).norm(), 0.0, kForceTol_N) << x_m << ' ' << z_m;
  });
}

TEST(TextureForce, OfNormalPerturbationLeansWithTheSlope) {
  const RenderTexture texture = make_render_texture(sine(), {.model = TextureForceModel::kNormalPerturbation});
  at_all_places([&](double x_m, double z_m) {
    const double k = slope(x_m);
    const Eigen::Vector3d m = Eigen::Vector3d(-k, 0.0, 1.0) / std::sqrt(1.0 + k * k);
    const Eigen::Vector3d expected = 0.7 * 800.0 * depth_m(x_m, z_m) * m;
    EXPECT_NEAR((force_N(texture, touch_at(x_m, z_m)) - expected).norm(), 0.0, kForceTol_N) << x_m << ' ' << z_m;
  });
}

// The lateral force is minus the slope of the energy ½ k_c k_s (H − z)² that the place holds.
TEST(TextureForce, OfALateralGradientDerivesFromAnEnergy) {
  const RenderTexture texture = make_render_texture(sine(), {.model = TextureForceModel::kLateralGradient});
  const auto energy_J = [](double x_m, double z_m) {
    return 0.5 * 0.7 * 800.0 * std::pow(std::max(height_m(x_m) - z_m, 0.0), 2);
  };
  at_all_places([&](double x_m, double z_m) {
    constexpr double kStep_m = 1e-6;
    const double expected = -(energy_J(x_m + kStep_m, z_m) - energy_J(x_m - kStep_m, z_m)) / (2.0 * kStep_m);
    const Eigen::Vector3d force = force_N(texture, touch_at(x_m, z_m));
    EXPECT_NEAR(force.x(), expected, 2e-4 + 1e-4 * std::abs(expected)) << x_m << ' ' << z_m;
    EXPECT_EQ(force.z(), 0.0);
  });
}

TEST(TextureForce, FadesTowardsTheBorderOfItsArea) {
  const RenderTexture texture = make_render_texture(sine(), {});
  TextureTouch touch = touch_at(1.1e-3, -1e-4);
  touch.fade = 0.25;
  TextureState state;
  const TextureForce force = texture_force(texture, state, touch);
  EXPECT_NEAR(force.height_m, 0.25 * height_m(1.1e-3), 1e-9);
  EXPECT_NEAR(force.force_N.z(), 0.7 * 800.0 * 0.25 * height_m(1.1e-3), kForceTol_N);
  touch.fade = 0.0;
  EXPECT_EQ(texture_force(texture, state, touch).force_N, Eigen::Vector3d::Zero());
}

TEST(TextureForce, IsZeroForWhatIsNotANumber) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  const RenderTexture texture = make_render_texture(sine(), {.model = TextureForceModel::kNormalPerturbation});
  for (const double bad : {nan, infinity, -infinity}) {
    for (int which = 0; which < 8; ++which) {
      TextureTouch touch = touch_at(1e-3, -1e-4);
      double* const scalars[] = {&touch.x_m,        &touch.z_m,
                                 &touch.fade,       &touch.stiffness_N_per_m,
                                 &touch.normal.x(), &touch.x_gradient.y(),
                                 &touch.contact_N,  &touch.compliance_kc};
      *scalars[which] = bad;
      EXPECT_EQ(force_N(texture, touch), Eigen::Vector3d::Zero()) << which;
    }
  }
}

TEST(TextureForce, RefusesModelsThatATextureCannotServe) {
  const Texture height = sine();
  EXPECT_THROW(make_render_texture(height, {.model = kForceModelOf<AutoregressiveTexture>}), Error);
  EXPECT_THROW(make_render_texture(height, {.model = kForceModelOf<DecayingSinusoids>}), Error);
  Texture series;
  series.model = DecayingSinusoids{};
  EXPECT_THROW(make_render_texture(series, {.model = TextureForceModel::kLateralGradient}), Error);
}

}  // namespace
}  // namespace asperity
