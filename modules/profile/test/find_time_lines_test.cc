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
constexpr double kPlace_m = 5e-6;  // standard deviation of places

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
    const std::vector<TimeLine> lines = find_time_lines(stroke.profile, height_m, kPlace_m);
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
      for (const TimeLine& line : find_time_lines(stroke.profile, height_m, kPlace_m))
        EXPECT_TRUE(line.could_be_surface);
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
    const std::vector<TimeLine> lines = find_time_lines(stroke.profile, height_m, kPlace_m);
    ASSERT_GE(lines.size(), 1u);
    EXPECT_TRUE(lines[0].could_be_surface);
  }
}

// One in 1,000 is allowed, of all lines; weak ones are left out.
TEST(FindTimeLines, RoughSurfacesHaveNone) {
  int found = 0;
  for (std::uint64_t seed = 100; seed < 400; ++seed) {
    const Stroke stroke = make_stroke(0.2, 1600);
    found += find_time_lines(stroke.profile, rough_surface(stroke, seed), kPlace_m).empty() ? 0 : 1;
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
  const std::vector<TimeLine> lines = find_time_lines(stroke.profile, height_m, kPlace_m);
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_NEAR(lines[0].frequency_Hz, 60.0, 0.02);
  EXPECT_NEAR(lines[0].rms_m, 3e-6, 0.1 * 3e-6);
}

// Two turns of a circle at v = 40 mm/s · (1 + a cos 2θ); ribs over y are crossed straight on at θ = 0° and 180°.
struct Circle {
  Stroke stroke;
  std::vector<Eigen::Vector2d> at_m;
};

Circle make_circle(double radius_m, double a) {
  Circle out;
  double t = 0.0;
  const int points = static_cast<int>(2.0 * kTurn * radius_m / out.stroke.profile.spacing_m);
  for (int i = 0; i < points; ++i) {
    const double s_m = i * out.stroke.profile.spacing_m, theta = s_m / radius_m;
    const double v = 0.04 * (1.0 + a * std::cos(2.0 * theta));
    t += out.stroke.profile.spacing_m / v;
    out.stroke.profile.s_m.push_back(s_m);
    out.stroke.profile.speed_mps.push_back(v);
    out.stroke.times_s.push_back(t);
    out.at_m.emplace_back(radius_m * std::cos(theta), radius_m * std::sin(theta));
  }
  return out;
}

// Where the hand is slow as it crosses them straight on, ribs under a circle are a line over time and none over the
// path.
TEST(FindTimeLines, RibsUnderACircleAreOfTheSurface) {
  int taken_for_vibration = 0;  // if nothing is known of the path
  for (const double radius_m : {10e-3, 20e-3}) {
    for (const double a : {-0.2, -0.3, -0.4}) {
      for (const double pitch_m : {0.4e-3, 0.7e-3, 1.2e-3}) {
        SCOPED_TRACE(testing::Message() << radius_m << ' ' << a << ' ' << pitch_m);
        const Circle circle = make_circle(radius_m, a);
        std::vector<double> height_m = rough_surface(circle.stroke, 5), across_m;
        for (const Eigen::Vector2d& p : circle.at_m) across_m.push_back(p.y());
        add_wave(across_m, 1.0 / pitch_m, 20e-6, height_m);
        for (const TimeLine& line : find_time_lines(circle.stroke.profile, height_m, kPlace_m, circle.at_m))
          EXPECT_TRUE(line.could_be_surface) << line.frequency_Hz;
        for (const TimeLine& line : find_time_lines(circle.stroke.profile, height_m, kPlace_m))
          taken_for_vibration += line.could_be_surface ? 0 : 1;
      }
    }
  }
  EXPECT_GT(taken_for_vibration, 5);
}

TEST(FindTimeLines, HumOnACircleIsNot) {
  const Circle circle = make_circle(15e-3, -0.2);
  std::vector<double> height_m = rough_surface(circle.stroke, 6), across_m;
  for (const Eigen::Vector2d& p : circle.at_m) across_m.push_back(p.x());
  add_wave(across_m, 1.0 / 1.1e-3, 15e-6, height_m);
  add_wave(circle.stroke.times_s, 60.0, 8e-6, height_m);
  int of_time = 0;
  for (const TimeLine& line : find_time_lines(circle.stroke.profile, height_m, kPlace_m, circle.at_m)) {
    if (line.could_be_surface) continue;
    ++of_time;
    EXPECT_NEAR(line.frequency_Hz, 60.0, 0.1);
  }
  EXPECT_EQ(of_time, 1);
}

// A stage moves evenly; errors of the places smear a fine pattern over the path, and over time as little as its speed.
TEST(FindTimeLines, AFinePatternAtUncertainPlacesCouldBeOfTheSurface) {
  int taken_for_vibration = 0;  // if places were thought exact
  for (const double sigma_m : {30e-6, 40e-6, 60e-6}) {
    SCOPED_TRACE(sigma_m);
    Stroke stroke = make_stroke(0.0);
    std::vector<double> height_m = rough_surface(stroke, 7);
    // The place errs by waves of some centimetres.
    std::vector<double> true_m;
    for (const double s_m : stroke.profile.s_m)
      true_m.push_back(s_m + sigma_m * (std::sin(kTurn * s_m / 0.023) + std::sin(kTurn * s_m / 0.0091 + 1.0)));
    add_wave(true_m, 1.0 / 0.2e-3, 10e-6, height_m);
    // The times follow the true place: the stage is even, the measured speed is not.
    for (std::size_t i = 0; i < true_m.size(); ++i) stroke.profile.t_s.push_back(true_m[i] / 0.04);
    for (const TimeLine& line : find_time_lines(stroke.profile, height_m, sigma_m)) EXPECT_TRUE(line.could_be_surface);
    for (const TimeLine& line : find_time_lines(stroke.profile, height_m, kPlace_m))
      taken_for_vibration += line.could_be_surface ? 0 : 1;
  }
  EXPECT_GT(taken_for_vibration, 0);
}

// The tip is lifted four times; the clock goes on.
TEST(FindTimeLines, LiftsDoNotBreakThePhase) {
  Stroke stroke = make_stroke(0.2, 6400);
  for (std::size_t i = 0; i < stroke.times_s.size(); ++i)
    stroke.profile.t_s.push_back(stroke.times_s[i] + 0.0711 * static_cast<double>(i / 1280));
  std::vector<double> height_m = rough_surface(stroke, 8);
  add_wave(stroke.profile.t_s, 60.0, 4e-6, height_m);
  for (std::size_t i = 0; i < height_m.size(); ++i) {
    if (i % 1280 > 1270) height_m[i] = kNan;
  }
  const std::vector<TimeLine> lines = find_time_lines(stroke.profile, height_m, kPlace_m);
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_NEAR(lines[0].frequency_Hz, 60.0, 0.05);
  EXPECT_NEAR(lines[0].rms_m, 4e-6, 0.1 * 4e-6);
  EXPECT_FALSE(lines[0].could_be_surface);
}

TEST(FindTimeLines, WithoutAnErrorOfPlacesNothingIsConcluded) {
  const Stroke stroke = make_stroke(0.2);
  std::vector<double> height_m = rough_surface(stroke, 1);
  add_wave(stroke.times_s, 60.0, 5e-6, height_m);
  for (const TimeLine& line : find_time_lines(stroke.profile, height_m, kNan)) EXPECT_TRUE(line.could_be_surface);
}

TEST(FindTimeLines, NoneWithoutSpeedsOrHeights) {
  Stroke stroke = make_stroke(0.1);
  const std::vector<double> height_m = rough_surface(stroke, 1);
  EXPECT_TRUE(find_time_lines(stroke.profile, std::vector<double>(height_m.size(), kNan), kPlace_m).empty());
  EXPECT_TRUE(find_time_lines(stroke.profile, std::vector<double>(height_m.size(), 0.0), kPlace_m).empty());
  stroke.profile.speed_mps.assign(stroke.profile.size(), kNan);
  EXPECT_TRUE(find_time_lines(stroke.profile, height_m, kPlace_m).empty());
  stroke.profile.speed_mps.clear();
  EXPECT_TRUE(find_time_lines(stroke.profile, height_m, kPlace_m).empty());
  EXPECT_TRUE(find_time_lines(Profile{}, {}, kPlace_m).empty());
}

}  // namespace
}  // namespace asperity
