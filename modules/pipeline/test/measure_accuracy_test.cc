#include "asperity/pipeline/measure_accuracy.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "asperity/base/error.h"
#include "asperity/pipeline/true_profile.h"
#include "asperity/profile/make_profile_thesis.h"

namespace asperity {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kSpeed_mps = 0.025;
constexpr double kPitch_mm = 2.0;
constexpr double kAmplitude_m = 1e-4;
constexpr std::int64_t kStep_ns = 1'000'000;
constexpr std::size_t kSamples = 3000;

double wave_m(double s_m) { return kAmplitude_m * std::sin(2.0 * std::numbers::pi * s_m * 1e3 / kPitch_mm); }

Truth make_truth() {
  Truth truth;
  for (std::size_t i = 0; i < kSamples; ++i) {
    const double s_m = kSpeed_mps * 1e-3 * static_cast<double>(i);
    truth.t_ns.push_back(static_cast<std::int64_t>(i) * kStep_ns);
    truth.s_m.push_back(s_m);
    truth.height_m.push_back(wave_m(s_m));
    truth.p_world_tip_m.emplace_back(s_m, 0.0, 0.0);
    truth.q_world_marker.push_back(Eigen::Quaterniond::Identity());
    truth.force_N.push_back(1.0);
  }
  return truth;
}

// The tip is 0.1 m before the marker's origin; poses come 10 ms late and 40 µm beside the truth.
Recording make_recording() {
  Recording recording;
  recording.truth = make_truth();
  recording.calibration.tip_in_marker_m = {0.0, 0.0, 0.1};
  recording.calibration.tracker.latency_s = 0.01;
  for (std::size_t i = 0; i < kSamples; i += 10) {
    recording.probe.t_ns.push_back(recording.truth->t_ns[i]);
    recording.tracker.t_ns.push_back(recording.truth->t_ns[i] + 10 * kStep_ns);
    Pose pose;
    pose.translation_m = recording.truth->p_world_tip_m[i] - Eigen::Vector3d(0.0, 40e-6, 0.1);
    recording.tracker.T_world_marker.push_back(pose);
  }
  return recording;
}

TipMotion make_motion(const Recording& recording, const Eigen::Vector3d& offset_m) {
  TipMotion motion;
  for (std::size_t i = 100; i + 100 < kSamples; i += 7) {
    motion.t_ns.push_back(recording.truth->t_ns[i]);
    motion.p_world_tip_m.push_back(recording.truth->p_world_tip_m[i] + offset_m);
  }
  return motion;
}

Profile make_sine_profile(double scale) {
  Profile profile;
  for (std::size_t i = 0; i < 2900; ++i) {
    profile.s_m.push_back(static_cast<double>(i) * profile.spacing_m);
    profile.height_m.push_back(scale * wave_m(profile.s_m.back()));
  }
  return profile;
}

TEST(MeasureAccuracy, ConstantOffsetsAreTheirLength) {
  const Recording recording = make_recording();
  const TipMotion motion = make_motion(recording, {10e-6, 20e-6, -20e-6});
  const Accuracy accuracy = measure_accuracy(recording, motion, make_sine_profile(0.8), {});
  constexpr double kRounding_m = 1e-12;  // straight lines through a straight motion
  EXPECT_NEAR(accuracy.position_rms_m, 30e-6, kRounding_m);
  EXPECT_NEAR(accuracy.tracker_rms_m, 40e-6, kRounding_m);
  EXPECT_EQ(accuracy.compared, static_cast<std::size_t>((motion.t_ns.back() - motion.t_ns.front()) / kStep_ns) + 1);
  ASSERT_TRUE(accuracy.profile);
  constexpr double kEnds = 1e-3;  // what is left of the band-pass's ends behind 3 mm of margin
  EXPECT_NEAR(accuracy.profile->correlation, 1.0, kEnds);
  EXPECT_NEAR(accuracy.profile->gain, 0.8, kEnds);
  EXPECT_NEAR(accuracy.band_high_cycles_per_mm, 0.4 * 100.0 / 25.0, 1e-3);  // the probe's 100 Hz at 25 mm/s
}

// A baseline's heights drift; what it compares is its texture, against the truth through the same filter.
TEST(MeasureAccuracy, ATextureIsComparedThroughItsOwnHighPass) {
  Recording recording = make_recording();
  // A wave of 6 mm, a third of whose amplitude the filter leaves, in truth and measurement alike.
  const auto both = [](double s_m) { return wave_m(s_m) + 2.0 * wave_m(s_m / 3.0); };
  for (std::size_t i = 0; i < kSamples; ++i) recording.truth->height_m[i] = both(recording.truth->s_m[i]);
  Profile profile = make_sine_profile(0.0);
  std::vector<double> height_m;
  for (const double s_m : profile.s_m) height_m.push_back(0.8 * both(s_m));
  const ThesisProfileConfig config;
  profile.texture_m = extract_texture_thesis(height_m, config);
  for (std::size_t i = 0; i < profile.size(); ++i) profile.height_m[i] = 0.1 * profile.s_m[i];
  const TextureOf texture_of = [&](const std::vector<double>& h) { return extract_texture_thesis(h, config); };
  const Accuracy accuracy =
      measure_accuracy(recording, make_motion(recording, Eigen::Vector3d::Zero()), profile, {}, texture_of);
  ASSERT_TRUE(accuracy.profile);
  constexpr double kEnds = 1e-3;
  EXPECT_NEAR(accuracy.profile->correlation, 1.0, kEnds);
  EXPECT_NEAR(accuracy.profile->gain, 0.8, kEnds);
  // Of the 2 mm wave (0.5 cycles/mm, −3 dB at 0.4) the two-pass filter leaves most, of the 6 mm wave little.
  EXPECT_LT(accuracy.profile->true_rms_um, 1e6 * kAmplitude_m);
}

TEST(MeasureAccuracy, TremorAtRestDoesNotLengthenTheTruth) {
  Recording recording = make_recording();
  constexpr std::size_t kRest = 500;
  constexpr double kTremor_m = 50e-6, kTremor_Hz = 10.0;
  Truth& truth = *recording.truth;
  const double first_m = truth.s_m[kRest], last_m = truth.s_m[kSamples - kRest];
  for (std::size_t i = 0; i < kSamples; ++i) {
    if (i >= kRest && i < kSamples - kRest) continue;
    const double t_s = 1e-3 * static_cast<double>(i);
    truth.s_m[i] = (i < kRest ? first_m : last_m) + kTremor_m * std::sin(2.0 * std::numbers::pi * kTremor_Hz * t_s);
    truth.height_m[i] = wave_m(truth.s_m[i]);
  }
  Profile profile;
  profile.from_m = 0.0;
  profile.to_m = last_m - first_m;
  for (std::size_t i = 1; static_cast<double>(i) * profile.spacing_m < profile.to_m; ++i) {
    profile.s_m.push_back(static_cast<double>(i) * profile.spacing_m);
    profile.height_m.push_back(wave_m(profile.s_m.back() + first_m));
  }
  const Accuracy accuracy = measure_accuracy(recording, make_motion(recording, Eigen::Vector3d::Zero()), profile, {});
  ASSERT_TRUE(accuracy.profile);
  // A tenth of a second is one period, whose median is 0 but for its samples' spacing of 3 µm, of 50 mm.
  EXPECT_NEAR(accuracy.profile->length_error_percent, 0.0, 0.01);
}

TEST(MeasureAccuracy, ATipThatTravelsFromTheFirstSampleOnLosesNoLength) {
  const Recording recording = make_recording();
  Profile profile = make_sine_profile(1.0);
  profile.from_m = 0.0;
  profile.to_m = recording.truth->s_m.back();
  while (profile.s_m.back() + profile.spacing_m < profile.to_m) {
    profile.s_m.push_back(static_cast<double>(profile.size()) * profile.spacing_m);
    profile.height_m.push_back(wave_m(profile.s_m.back()));
  }
  const Accuracy accuracy = measure_accuracy(recording, make_motion(recording, Eigen::Vector3d::Zero()), profile, {});
  ASSERT_TRUE(accuracy.profile);
  EXPECT_NEAR(accuracy.profile->length_error_percent, 0.0, 1e-9);
}

TEST(MeasureAccuracy, WithoutHeightsOnlyPositionsAreCompared) {
  Recording recording = make_recording();
  recording.truth->height_m.assign(kSamples, kNan);
  const Accuracy accuracy = measure_accuracy(recording, make_motion(recording, {0.0, 0.0, 1e-3}), {}, {});
  EXPECT_FALSE(accuracy.profile);
  EXPECT_NEAR(accuracy.position_rms_m, 1e-3, 1e-12);
}

TEST(MeasureAccuracy, RefusesWhatCannotBeCompared) {
  Recording recording = make_recording();
  TipMotion motion = make_motion(recording, Eigen::Vector3d::Zero());
  for (std::int64_t& t_ns : motion.t_ns) t_ns += std::int64_t{100} * kStep_ns * static_cast<std::int64_t>(kSamples);
  EXPECT_THROW(measure_accuracy(recording, motion, {}, {}), Error);
  recording.truth.reset();
  EXPECT_THROW(measure_accuracy(recording, motion, {}, {}), Error);
}

TEST(TrueProfile, IsTheTruthOnTheProfilesGrid) {
  const ProfileConfig config;
  const Profile profile = true_profile(make_truth(), config);
  ASSERT_GT(profile.size(), 2900u);
  constexpr double kSpline_m = 0.2e-6;  // the low-pass's 0.1 % of the amplitude and the spline's ends
  for (std::size_t i = 100; i + 100 < profile.size(); ++i) {
    ASSERT_NEAR(profile.s_m[i], static_cast<double>(i) * config.spacing_m, 1e-12);
    ASSERT_NEAR(profile.height_m[i], wave_m(profile.s_m[i]), kSpline_m);
  }
  EXPECT_EQ(profile.texture_m.size(), profile.size());
  EXPECT_THROW(true_profile({}, config), Error);
}

}  // namespace
}  // namespace asperity
