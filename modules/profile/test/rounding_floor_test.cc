#include "asperity/profile/rounding_floor.h"

#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>

#include <gtest/gtest.h>

#include "asperity/profile/measure_areal_texture.h"
#include "asperity/profile/measure_roughness.h"
#include "asperity/profile/read_heights.h"

namespace asperity {
namespace {

struct Read {
  Heights heights;
  HeightsOrigin origin;
};

Read read(const std::string& text) {
  Read out;
  out.heights = parse_heights(text, "f.csv", {.spacing_m = 1e-6}, nullptr, &out.origin);
  return out;
}

std::string fixed(double value, int decimals) {
  std::string out(64, '\0');
  out.resize(static_cast<std::size_t>(std::snprintf(out.data(), out.size(), "%.*f", decimals, value)));
  return out;
}

// 400 heights in µm, with a number of decimals.
template <class Height>
std::string lines(const Height& height_um, int decimals) {
  std::string out;
  for (int i = 0; i < 400; ++i) out += fixed(height_um(i), decimals) + "\n";
  return out;
}

RoughnessResult roughness_after(const Read& from, std::string& note) {
  const auto& profile = std::get<HeightProfile>(from.heights);
  RoughnessResult out = measure_roughness(profile.height_m, profile.spacing_m);
  note = apply_rounding_floor(from.origin, out);
  return out;
}

TEST(RoundingFloor, AConstantIsFlatAndHasNoShape) {
  std::string note;
  const RoughnessResult r = roughness_after(read(lines([](int) { return 3.0; }, 6)), note);
  EXPECT_EQ(r.Ra_m, 0.0);
  EXPECT_EQ(r.Rz_m, 0.0);
  EXPECT_TRUE(std::isnan(r.Rsk));
  EXPECT_TRUE(std::isnan(r.Rku));
  EXPECT_TRUE(std::isnan(r.RSm_m));
  EXPECT_FALSE(note.empty());
}

// A sine well above the last digit has its own Ra = 2 A/π; a single step of the last digit may be rounding.
TEST(RoundingFloor, ATextureBelowTheLastDigitIsNotDetermined) {
  const auto sine = [](int i) { return 100.0 + 0.6 * std::sin(2.0 * std::numbers::pi * i / 40.0); };
  std::string note;
  EXPECT_NEAR(roughness_after(read(lines(sine, 3)), note).Ra_m, 2.0 / std::numbers::pi * 0.6e-6, 2e-9);
  EXPECT_TRUE(note.empty());
  const auto step = [](int i) { return i % 8 == 0 ? 7.001 : 7.0; };
  const RoughnessResult r = roughness_after(read(lines(step, 3)), note);  // one digit in eight: RMS 0.33 of it
  EXPECT_TRUE(std::isnan(r.Ra_m));
  EXPECT_TRUE(std::isnan(r.RSm_m));
  EXPECT_NE(note.find("within the rounding"), std::string::npos);
}

TEST(RoundingFloor, APlaneHasNoDirection) {
  std::string text = "x_mm,y_mm,z_um\n";
  for (int row = 0; row < 30; ++row) {
    for (int column = 0; column < 30; ++column)
      text += fixed(0.005 * column, 6) + "," + fixed(0.005 * row, 6) + "," + fixed(0.5 * column + 0.25 * row, 6) + "\n";
  }
  const Read plane = read(text);
  ArealTextureResult r = measure_areal_texture(std::get<ArealMap>(plane.heights));
  EXPECT_FALSE(apply_rounding_floor(plane.origin, r).empty());
  EXPECT_EQ(r.Sq_m, 0.0);
  EXPECT_EQ(r.Sdq, 0.0);
  EXPECT_TRUE(std::isnan(r.Str));
  EXPECT_TRUE(std::isnan(r.Std_rad));
  EXPECT_TRUE(std::isnan(r.Sal_m));
}

// A ramp's P is the ramp; its R is nothing.
TEST(RoundingFloor, OfARampOnlyRIsFlat) {
  const Read ramp = read(lines([](int i) { return 0.005 * i; }, 6));
  const auto& profile = std::get<HeightProfile>(ramp.heights);
  RoughnessConfig config;
  config.lambda_c_mm = 0.08;
  ProfileTexture texture = measure_profile_texture(profile.height_m, profile.spacing_m, config);
  const double P_m = texture.P.q_m;
  EXPECT_FALSE(apply_rounding_floor(ramp.origin, texture).empty());
  EXPECT_EQ(texture.P.q_m, P_m);
  EXPECT_EQ(texture.R->q_m, 0.0);
  EXPECT_TRUE(std::isnan(texture.R->sm_m));
}

}  // namespace
}  // namespace asperity
