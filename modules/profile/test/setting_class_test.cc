#include "asperity/profile/setting_class.h"

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "asperity/base/error.h"

namespace asperity {
namespace {

std::vector<double> sine(double amplitude_m, double pitch_m, double length_m, double spacing_m) {
  std::vector<double> out(static_cast<std::size_t>(std::lround(length_m / spacing_m)));
  for (std::size_t i = 0; i < out.size(); ++i)
    out[i] = amplitude_m * std::sin(2.0 * std::numbers::pi * static_cast<double>(i) * spacing_m / pitch_m);
  return out;
}

// Ra of a sine is 2 A / π, far below the cut-off untouched.
TEST(SettingClass, TheOneWhoseRangeHoldsTheRa) {
  const auto chosen = [](double Ra_m, double pitch_m, double length_m, double spacing_m) {
    return choose_setting_class(sine(Ra_m * std::numbers::pi / 2.0, pitch_m, length_m, spacing_m), spacing_m).name;
  };
  EXPECT_EQ(chosen(0.01e-6, 0.01e-3, 0.5e-3, 0.5e-6), "Sc1");
  EXPECT_EQ(chosen(0.05e-6, 0.03e-3, 1.5e-3, 0.5e-6), "Sc2");
  EXPECT_EQ(chosen(1e-6, 0.1e-3, 5e-3, 1e-6), "Sc3");
  EXPECT_EQ(chosen(5e-6, 0.3e-3, 13e-3, 3e-6), "Sc4");
  EXPECT_EQ(chosen(30e-6, 1e-3, 41e-3, 10e-6), "Sc5");
}

// A short profile gets the coarsest class that it holds a section of.
TEST(SettingClass, NotLongerThanTheProfile) {
  const auto z = sine(30e-6, 0.1e-3, 1.6e-3, 0.5e-6);
  EXPECT_EQ(choose_setting_class(z, 0.5e-6).name, "Sc3");
  const RoughnessConfig config = with_setting_class(kSettingClasses[2], z.size(), 0.5e-6);
  EXPECT_EQ(config.sections, 2);
  EXPECT_DOUBLE_EQ(config.lambda_c_mm, 0.8);
  EXPECT_DOUBLE_EQ(config.lambda_s_mm, 0.0025);
  EXPECT_EQ(with_setting_class(kSettingClasses[2], 400, 25e-6).lambda_s_mm, 0.0)
      << "heights 25 µm apart hold no 2.5 µm";
  EXPECT_THROW(choose_setting_class(sine(1e-6, 0.01e-3, 0.05e-3, 0.5e-6), 0.5e-6), Error);
}

}  // namespace
}  // namespace asperity
