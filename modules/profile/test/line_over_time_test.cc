#include "asperity/profile/line_over_time.h"

#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "asperity/base/nan.h"
#include "asperity/base/random.h"

namespace asperity {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;

// A stroke of 80 mm at 40 mm/s, the speed changed by `change` as a hand's is; times_s are those of its points.
struct Stroke {
  Profile profile;
  std::vector<double> times_s;
};

Stroke make_stroke(double change) {
  Stroke out;
  double t = 0.0;
  for (int i = 0; i < 3200; ++i) {
    const double s_m = i * out.profile.spacing_m;
    const double v =
        0.04 * (1.0 + change * std::sin(kTurn * s_m / 0.03) + 0.5 * change * std::sin(kTurn * s_m / 0.011));
    t += out.profile.spacing_m / v;
    out.profile.s_m.push_back(s_m);
    out.profile.speed_mps.push_back(v);
    out.times_s.push_back(t);
  }
  return out;
}

// Ribs of 2 mm, or hum of 20 Hz, in noise of half their power.
std::vector<double> heights_of(const Stroke& stroke, bool of_the_path) {
  Random random(1, 0);
  std::vector<double> out;
  for (std::size_t i = 0; i < stroke.times_s.size(); ++i) {
    const double turns = of_the_path ? stroke.profile.s_m[i] / 2e-3 : 20.0 * stroke.times_s[i];
    out.push_back(20e-6 * std::cos(kTurn * turns) + 10e-6 * random.normal());
  }
  return out;
}

TEST(LineOverTime, APatternIsSmearedOverTimeAndHumOverThePath) {
  const Stroke stroke = make_stroke(0.25);
  EXPECT_LT(line_over_time(stroke.profile, heights_of(stroke, true), 2e-3), 0.5);
  // What a search over the path would take for its pitch is at the mean speed.
  EXPECT_GT(line_over_time(stroke.profile, heights_of(stroke, false), 2e-3), 1.5);
}

TEST(LineOverTime, AtAConstantSpeedTheTwoAreTheSame) {
  const Stroke stroke = make_stroke(0.0);
  EXPECT_NEAR(line_over_time(stroke.profile, heights_of(stroke, true), 2e-3), 1.0, 0.02);
  EXPECT_NEAR(line_over_time(stroke.profile, heights_of(stroke, false), 2e-3), 1.0, 0.02);
}

TEST(LineOverTime, IsNotDeterminedWithoutSpeeds) {
  Stroke stroke = make_stroke(0.1);
  const std::vector<double> heights_m = heights_of(stroke, true);
  EXPECT_TRUE(std::isnan(line_over_time(stroke.profile, heights_m, kNan)));
  stroke.profile.speed_mps.assign(stroke.profile.size(), kNan);
  EXPECT_TRUE(std::isnan(line_over_time(stroke.profile, heights_m, 2e-3)));
  stroke.profile.speed_mps.clear();
  EXPECT_TRUE(std::isnan(line_over_time(stroke.profile, heights_m, 2e-3)));
}

}  // namespace
}  // namespace asperity
