#include "asperity/profile/find_time_lines.h"

#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "asperity/base/nan.h"
#include "asperity/base/random.h"

namespace asperity {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;

// A stroke at 40 mm/s, the speed changed by `change` as a hand's is; times_s are those of its points.
struct Stroke {
  Profile profile;
  std::vector<double> times_s;
};

Stroke make_stroke(double change, int points = 3200) {
  Stroke out;
  double t = 0.0;
  for (int i = 0; i < points; ++i) {
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

// A surface of waves of all lengths, its slopes white: heights fall with the frequency as those of real ones do.
std::vector<double> rough_surface(const Stroke& stroke, std::uint64_t seed) {
  Random random(seed, 0);
  std::vector<double> out;
  double h = 0.0;
  for (std::size_t i = 0; i < stroke.times_s.size(); ++i) out.push_back(h = 0.98 * h + 2e-6 * random.normal());
  return out;
}

void add_wave(const std::vector<double>& at, double frequency, double rms_m, std::vector<double>& height_m) {
  for (std::size_t i = 0; i < at.size(); ++i)
    height_m[i] += std::numbers::sqrt2 * rms_m * std::cos(kTurn * frequency * at[i] + 0.3);
}

TEST(FindTimeLines, FindsHumWithItsFrequencyAndPower) {
  for (const double frequency_Hz : {50.0, 60.0, 137.0}) {
    SCOPED_TRACE(frequency_Hz);
    const Stroke stroke = make_stroke(0.2);
    std::vector<double> height_m = rough_surface(stroke, 1);
    add_wave(stroke.times_s, frequency_Hz, 5e-6, height_m);
    const std::vector<TimeLine> lines = find_time_lines(stroke.profile, height_m);
    ASSERT_EQ(lines.size(), 1u);
    // A stroke of 2 s: ordinates are 0.125 Hz apart.
    EXPECT_NEAR(lines[0].frequency_Hz, frequency_Hz, 0.07);
    EXPECT_NEAR(lines[0].rms_m, 5e-6, 0.1 * 5e-6);
    EXPECT_FALSE(lines[0].could_be_surface);
  }
}

TEST(FindTimeLines, APatternOfTheSurfaceIsNone) {
  for (const double pitch_m : {0.4e-3, 1e-3, 2e-3}) {
    for (const double change : {0.05, 0.2}) {
      SCOPED_TRACE(testing::Message() << pitch_m << " m, " << change);
      const Stroke stroke = make_stroke(change);
      std::vector<double> height_m = rough_surface(stroke, 2);
      add_wave(stroke.profile.s_m, 1.0 / pitch_m, 20e-6, height_m);
      add_wave(stroke.profile.s_m, 3.0 / pitch_m, 5e-6, height_m);
      for (const TimeLine& line : find_time_lines(stroke.profile, height_m)) EXPECT_TRUE(line.could_be_surface);
    }
  }
}

TEST(FindTimeLines, AtAConstantSpeedBothCouldBe) {
  const Stroke stroke = make_stroke(0.0);
  for (const bool of_the_path : {true, false}) {
    std::vector<double> height_m = rough_surface(stroke, 3);
    if (of_the_path) {
      add_wave(stroke.profile.s_m, 500.0, 20e-6, height_m);
    } else {
      add_wave(stroke.times_s, 20.0, 20e-6, height_m);
    }
    const std::vector<TimeLine> lines = find_time_lines(stroke.profile, height_m);
    ASSERT_GE(lines.size(), 1u);
    EXPECT_TRUE(lines[0].could_be_surface);
  }
}

// One in 1,000 is allowed, of all lines; weak ones are left out.
TEST(FindTimeLines, RoughSurfacesHaveNone) {
  int found = 0;
  for (std::uint64_t seed = 100; seed < 400; ++seed) {
    const Stroke stroke = make_stroke(0.2, 1600);
    found += find_time_lines(stroke.profile, rough_surface(stroke, seed)).empty() ? 0 : 1;
  }
  EXPECT_LE(found, 2);
}

// Twenty seconds and gaps: the mean of several windows, and a tip that is not there.
TEST(FindTimeLines, LongStrokesWithGapsAndRests) {
  Stroke stroke = make_stroke(0.2, 32000);
  std::vector<double> height_m = rough_surface(stroke, 4);
  add_wave(stroke.times_s, 60.0, 3e-6, height_m);
  for (std::size_t i = 9000; i < 9400; ++i) height_m[i] = stroke.profile.speed_mps[i] = kNan;
  for (std::size_t i = 20000; i < 20010; ++i) stroke.profile.speed_mps[i] = 1e-6;
  const std::vector<TimeLine> lines = find_time_lines(stroke.profile, height_m);
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_NEAR(lines[0].frequency_Hz, 60.0, 0.02);
  EXPECT_NEAR(lines[0].rms_m, 3e-6, 0.1 * 3e-6);
}

TEST(FindTimeLines, NoneWithoutSpeedsOrHeights) {
  Stroke stroke = make_stroke(0.1);
  const std::vector<double> height_m = rough_surface(stroke, 1);
  EXPECT_TRUE(find_time_lines(stroke.profile, std::vector<double>(height_m.size(), kNan)).empty());
  EXPECT_TRUE(find_time_lines(stroke.profile, std::vector<double>(height_m.size(), 0.0)).empty());
  stroke.profile.speed_mps.assign(stroke.profile.size(), kNan);
  EXPECT_TRUE(find_time_lines(stroke.profile, height_m).empty());
  stroke.profile.speed_mps.clear();
  EXPECT_TRUE(find_time_lines(stroke.profile, height_m).empty());
  EXPECT_TRUE(find_time_lines(Profile{}, {}).empty());
}

}  // namespace
}  // namespace asperity
