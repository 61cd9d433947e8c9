#include "asperity/calibration/calibrate_tracker_noise.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "asperity/base/error.h"
#include "asperity/base/random.h"
#include "asperity/geometry/pose.h"
#include "coverage.h"

namespace asperity {
namespace {

constexpr double kAcross_m = 0.3e-3, kAlong_m = 3e-3;  // at 1 m
constexpr double kAbout_rad = 3e-3, kTilt_rad = 9e-3;
constexpr double kTiltPower = 0.7;

struct Place {
  Eigen::Vector3d p_m;
  double tilt_rad = 0.0;
  double length_s = 20.0;
};

// Poses of a body that rests at each place in turn and moves in between, with noise in the ray's frame.
TrackerStream simulate(Random& random, const std::vector<Place>& places, double rate_Hz = 45.0) {
  TrackerStream out;
  std::int64_t t_ns = 1'000'000'000;
  const auto step_ns = static_cast<std::int64_t>(1e9 / rate_Hz);
  Eigen::Vector3d at = places[0].p_m;
  double tilt = places[0].tilt_rad;
  const auto add = [&] {
    const Eigen::Quaterniond to_ray = shortest_rotation(Eigen::Vector3d::UnitZ(), at);
    const double d = at.norm(), steep = std::pow(std::cos(tilt), -kTiltPower);
    const auto noise = [&](double across, double along) {
      return Eigen::Vector3d(steep * (to_ray * Eigen::Vector3d(across * random.normal(), across * random.normal(),
                                                               along * random.normal())));
    };
    // Facing the camera, then tilted about its own x axis.
    const Eigen::Quaterniond rotation = to_ray * exp_rotation({tilt, 0.0, 0.0});
    out.t_ns.push_back(t_ns);
    out.T_world_marker.push_back({exp_rotation(noise(kTilt_rad * d * d, kAbout_rad * d)) * rotation,
                                  at + noise(kAcross_m * d, kAlong_m * d * d)});
    t_ns += step_ns;
  };
  for (const Place& place : places) {
    const Eigen::Vector3d from = at;
    const double from_tilt = tilt;
    for (int i = 0; i < 60; ++i) {
      at = from + (place.p_m - from) * (i / 60.0);
      tilt = from_tilt + (place.tilt_rad - from_tilt) * (i / 60.0);
      add();
    }
    at = place.p_m;
    tilt = place.tilt_rad;
    for (int i = 0; i < static_cast<int>(place.length_s * rate_Hz); ++i) add();
  }
  return out;
}

std::vector<Place> many_places() {
  return {{{0.0, 0.0, 0.25}, 0.1}, {{0.05, 0.02, 0.3}, 0.9}, {{-0.08, 0.05, 0.4}, 0.4},
          {{0.1, -0.1, 0.5}, 0.8}, {{0.0, 0.1, 0.6}, 0.2},   {{0.02, 0.0, 0.35}, 0.6}};
}

TEST(TrackerNoise, StandardErrorsAreTrue) {
  constexpr std::size_t kTrials = 200;
  test::Coverage coverage;
  std::size_t not_gaussian = 0;
  for (std::size_t trial = 0; trial < kTrials; ++trial) {
    Random random(60, trial);
    std::vector<Place> places = many_places();
    for (Place& place : places) place.length_s = 6.5;
    const TrackerStream tracker = simulate(random, places);
    const StaticTracker recording{"simulated", &tracker, {}, true};
    const TrackerNoise noise = calibrate_tracker_noise({&recording, 1});
    ASSERT_EQ(noise.rests.size(), 6u);
    ASSERT_TRUE(noise.model);
    not_gaussian += !noise.gaussian;
    // On the optical axis the ray's frame is the world's.
    const StaticInterval& first = noise.rests[0];
    const double d = 0.25, steep = std::pow(std::cos(0.1), -kTiltPower);
    coverage.add("sigma_x", first.position_m[0].white, kAcross_m * d * steep, first.position_m[0].white_error);
    coverage.add("sigma_z", first.position_m[2].white, kAlong_m * d * d * steep, first.position_m[2].white_error);
    coverage.add("sigma_rx", first.rotation_rad[0].white, kTilt_rad * d * d * steep, first.rotation_rad[0].white_error);
    coverage.add("sigma_rz", first.rotation_rad[2].white, kAbout_rad * d * steep, first.rotation_rad[2].white_error);
    const TrackerNoiseModel& model = *noise.model;
    const auto add_law = [&](const std::string& name, const NoiseLaw& law, double scale) {
      coverage.add(name + " scale", law.scale, scale, law.scale_error);
      coverage.add(name + " tilt power", law.tilt_power, kTiltPower, law.tilt_power_error);
      coverage.add(name + " measured power", law.measured_power, law.power, law.measured_power_error);
    };
    add_law("across", model.across_m, kAcross_m);
    add_law("along", model.along_m, kAlong_m);
    add_law("about", model.about_rad, kAbout_rad);
    add_law("tilt", model.tilt_rad, kTilt_rad);
  }
  coverage.expect("tracker noise, model over distance and tilt", kTrials);
  // Thirty-six channels a trial, each with a chance of 1e-3 and then only if it is far from a Gaussian too.
  EXPECT_LE(not_gaussian, 10u);
}

TEST(TrackerNoise, FindsTheRestsOfOneRecording) {
  Random random(61);
  const TrackerStream tracker = simulate(random, many_places());
  const StaticTracker recording{"one", &tracker, {}, true};
  const TrackerNoise noise = calibrate_tracker_noise({&recording, 1});
  ASSERT_EQ(noise.rests.size(), 6u);
  for (std::size_t i = 0; i < 6; ++i) {
    // The mean of 800 poses of at most 1 mm, and the tilt by half a degree.
    EXPECT_LT((noise.rests[i].T_world_marker.translation_m - many_places()[i].p_m).norm(), 0.3e-3);
    EXPECT_NEAR(noise.rests[i].tilt_rad, many_places()[i].tilt_rad, 0.01);
  }
  EXPECT_TRUE(noise.verdict.trustworthy) << noise.verdict.text;
  EXPECT_FALSE(noise.moving);
}

TEST(TrackerNoise, OneRestGivesNoModelAndSaysWhy) {
  Random random(62);
  const TrackerStream tracker = simulate(random, {{{0.0, 0.0, 0.28}, 0.0}});
  const StaticTracker recording{"one", &tracker, {}, true};
  const TrackerNoise noise = calibrate_tracker_noise({&recording, 1});
  EXPECT_FALSE(noise.model);
  EXPECT_THAT(noise.no_model_because, testing::HasSubstr("several distances"));
}

TEST(TrackerNoise, SaysThatAHandMoves) {
  Random random(63);
  TrackerStream tracker = simulate(random, {{{0.0, 0.0, 0.28}, 0.0}});
  double sway = 0.0;
  for (Pose& pose : tracker.T_world_marker) {
    sway = 0.97 * sway + 0.12e-3 * random.normal();
    pose.translation_m.x() += sway;
  }
  const StaticTracker recording{"hand", &tracker, {}, true};
  const TrackerNoise noise = calibrate_tracker_noise({&recording, 1});
  EXPECT_TRUE(noise.moving);
  EXPECT_THAT(noise.verdict.text, testing::HasSubstr("The body moved"));
  const SeriesNoise& x = noise.rests[0].position_m[0];
  EXPECT_NEAR(x.white, kAcross_m * 0.28, 4.0 * x.white_error);
}

TEST(TrackerNoise, LeavesOutFlipsAndSaysSo) {
  Random random(64);
  TrackerStream tracker = simulate(random, {{{0.0, 0.0, 0.28}, 0.0}});
  for (std::size_t i = 100; i < 800; i += 100) tracker.T_world_marker[i].translation_m.z() += 0.01;
  const StaticTracker recording{"flips", &tracker, {}, true};
  const TrackerNoise noise = calibrate_tracker_noise({&recording, 1});
  ASSERT_EQ(noise.problems.size(), 1u);
  EXPECT_EQ(noise.problems[0].count, 7u);
  EXPECT_NEAR(noise.sigma_position_m.z(), kAlong_m * 0.28 * 0.28, 4.0 * noise.sigma_position_error_m.z());
}

TEST(TrackerNoise, IsNotGaussianWhereItIsNot) {
  Random random(65);
  TrackerStream tracker = simulate(random, {{{0.0, 0.0, 0.28}, 0.0}});
  for (Pose& pose : tracker.T_world_marker) pose.translation_m.y() += random.chance(0.1) ? 0.4e-3 : 0.0;
  const StaticTracker recording{"flicker", &tracker, {}, true};
  const TrackerNoise noise = calibrate_tracker_noise({&recording, 1});
  EXPECT_FALSE(noise.gaussian);
  // Its size is right; that it is not a Gaussian's limits what it may be used for.
  ASSERT_EQ(noise.verdict.verdicts.size(), 1u);
  EXPECT_EQ(noise.verdict.verdicts[0].code, "noise_not_gaussian");
  EXPECT_EQ(noise.verdict.verdicts[0].severity, Severity::kLimited);
}

TEST(TrackerNoise, RefusesWhatNeverRests) {
  Random random(66);
  TrackerStream tracker = simulate(random, {{{0.0, 0.0, 0.28}, 0.0}});
  for (std::size_t i = 0; i < tracker.size(); ++i)
    tracker.T_world_marker[i].translation_m.x() += 2e-4 * static_cast<double>(i);
  const StaticTracker recording{"moving", &tracker, {}, true};
  EXPECT_THROW(calibrate_tracker_noise({&recording, 1}), Error);
  // At rest for 60 of 45 poses a second and 3 s, then on its way over 50 mm: how long, and what ended it, is said.
  const TrackerStream brief = simulate(random, {{{0.0, 0.0, 0.28}, 0.0, 3.0}, {{0.05, 0.0, 0.28}, 0.0, 3.0}});
  const StaticTracker two{"brief", &brief, {}, true};
  try {
    calibrate_tracker_noise({&two, 1});
    FAIL();
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), testing::ContainsRegex("it was stationary for 4\\.[0-9]+ s at most, then it was [0-9.]+ "
                                                     "mm and [0-9.]+ mrad away, where 2 mm and 20 mrad are allowed"));
  }
  const TrackerStream empty;
  const StaticTracker nothing{"empty", &empty, {}, true};
  EXPECT_THROW(calibrate_tracker_noise({&nothing, 1}), Error);
}

}  // namespace
}  // namespace asperity
