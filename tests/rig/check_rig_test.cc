#include "asperity/rig/check_rig.h"

#include <gmock/gmock.h>

#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <string>

#include "asperity/base/error.h"
#include "asperity/base/random.h"
#include "asperity/geometry/pose.h"
#include "asperity/recording/uncalibrated.h"
#include "rig_bench.h"

namespace asperity {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

std::vector<std::string> codes(const RigCheck& check) {
  std::vector<std::string> out;
  for (const Verdict& verdict : check.verdicts) out.push_back(verdict.code);
  return out;
}

const Verdict& verdict_of(const RigCheck& check, const std::string& code) {
  for (const Verdict& verdict : check.verdicts) {
    if (verdict.code == code) return verdict;
  }
  static const Verdict none;
  ADD_FAILURE() << "no verdict " << code << ": " << check.verdict;
  return none;
}

RigCheck check_wrong(const std::function<void(Recording&)>& wrong) {
  return check_rig(grating_strokes(5, 100, wrong), {});
}

TEST(CheckRig, AGoodRigIsRight) {
  for (const std::uint64_t seed : {200U, 300U}) {
    const RigCheck check = check_rig(grating_strokes(5, seed, {}), {});
    std::printf("%s", rig_check_text(check, {}).c_str());
    EXPECT_TRUE(check.right) << check.verdict;
    EXPECT_EQ(verdict_word(check.verdicts), "valid") << check.verdict;
    EXPECT_THAT(check.verdict, IsEmpty());
    EXPECT_EQ(check.pitch_m.count, 5U);
    // Three times the mean's standard error as the strokes scatter (0.1 % of the pitch); three times the
    // accelerometer's 0.15 %, and the contact's 0.3 µm.
    EXPECT_NEAR(check.pitch_m.mean, 2e-3, 3e-6);
    EXPECT_NEAR(check.depth_m.mean, 0.2e-3, 1.5e-6);
    EXPECT_NEAR(check.Rq_m.mean, check.true_Rq_m, 0.02 * check.true_Rq_m);
    // Student's t for 5 strokes: 2.776 / √5.
    EXPECT_NEAR(check.pitch_m.half_width, 1.2415 * check.pitch_m.deviation, 1e-3 * check.pitch_m.half_width);
  }
}

TEST(CheckRig, ATagOfTheWrongSizeIsNamed) {
  const RigCheck check = check_wrong([](Recording& r) {
    for (Pose& T : r.tracker.T_world_marker) T.translation_m *= 1.02;
  });
  EXPECT_FALSE(check.right);
  EXPECT_NEAR(check.pitch_m.mean, 2.04e-3, 0.01e-3);
  EXPECT_THAT(verdict_of(check, "pitch_off").remedy, AllOf(HasSubstr("printed tag"), HasSubstr("calibrate camera")));
  EXPECT_THAT(codes(check), Not(Contains("depth_off")));  // the accelerometer knows nothing of tags
}

TEST(CheckRig, ALatencyOfFiveMillisecondsIsNamed) {
  std::vector<NamedRecording> strokes = grating_strokes(5, 100, {});
  for (NamedRecording& stroke : strokes) stroke.recording.calibration.tracker.latency_s += 5e-3;
  for (const double sigma_s : {2e-3, 0.5e-3}) {
    for (NamedRecording& stroke : strokes) stroke.recording.calibration.tracker.latency_sigma_s = sigma_s;
    const RigCheck check = check_rig(strokes, {});
    EXPECT_FALSE(check.right);
    EXPECT_THAT(verdict_of(check, "latency_off").remedy, HasSubstr("calibrate latency"));
    EXPECT_THAT(codes(check), Not(Contains("pitch_off")));
  }
}

TEST(CheckRig, AnAccelerometersWrongScaleIsNamed) {
  const RigCheck check = check_wrong([](Recording& r) { r.calibration.accelerometer.B *= 1.06; });
  EXPECT_FALSE(check.right);
  EXPECT_THAT(verdict_of(check, "depth_off").remedy, HasSubstr("calibrate accel"));
  EXPECT_THAT(verdict_of(check, "gravity_off").message, HasSubstr("-5."));
  EXPECT_THAT(codes(check), Not(Contains("pitch_off")));
}

TEST(CheckRig, AnotherDepthThanStatedIsNotBlamedOnTheAccelerometer) {
  CheckRigConfig config;
  config.grating.depth_m = 0.22e-3;
  const RigCheck check = check_rig(grating_strokes(2, 100, {}), config);
  EXPECT_THAT(verdict_of(check, "depth_off").remedy, HasSubstr("measure the depth of the print"));
}

// Turns about the marker's own axes by some degrees, for a fifth of a second or so.
TEST(CheckRig, AMarkerThatRattlesIsNamed) {
  const RigCheck check = check_wrong([](Recording& r) {
    Random random(r.tracker.size(), 7);
    double turn_rad = 0.0;
    for (Pose& T : r.tracker.T_world_marker) {
      turn_rad += -0.05 * turn_rad + 0.02 * random.normal();
      T.rotation = T.rotation * exp_rotation(Eigen::Vector3d(turn_rad, 0.0, turn_rad));
    }
  });
  EXPECT_FALSE(check.right);
  EXPECT_THAT(verdict_of(check, "gravity_tilted").remedy, HasSubstr("marker is not loose"));
}

TEST(CheckRig, ATipInTheWrongPlaceIsNamed) {
  const RigCheck check = check_wrong([](Recording& r) { r.calibration.tip_in_marker_m.y() += 10e-3; });
  EXPECT_FALSE(check.right);
  EXPECT_THAT(verdict_of(check, "length_wanders").remedy, HasSubstr("calibrate tip"));
  EXPECT_THAT(verdict_of(check, "pitch_off").remedy, HasSubstr("first correct"));
}

TEST(CheckRig, FewerStrokesLimitTheVerdict) {
  const RigCheck one = check_rig(grating_strokes(1, 100, {}), {});
  EXPECT_TRUE(one.right);
  EXPECT_EQ(verdict_word(one.verdicts), "limited") << one.verdict;
  EXPECT_THAT(one.verdict, HasSubstr("limited: 1 stroke of 5: repeatability is not known; scan more strokes"));
  EXPECT_TRUE(std::isnan(one.pitch_m.deviation));
  const auto json = nlohmann::json::parse(rig_check_json(one, {}));
  EXPECT_EQ(json["format"], "asperity-rig-check");
  EXPECT_TRUE(json["pitch_m"]["standard_deviation"].is_null());
  EXPECT_EQ(json["strokes"].size(), 1U);
  EXPECT_EQ(json["config"]["grating"]["pitch_m"], 2e-3);
  EXPECT_EQ(json["trustworthy"], true);
  EXPECT_EQ(json["verdicts"].size(), one.verdicts.size());
  EXPECT_THAT(rig_check_text(one, {}), HasSubstr("limited: 1 stroke of 5"));
  EXPECT_THAT(rig_check_text(one, {}), HasSubstr("\nRIGHT\n"));
}

TEST(CheckRig, WhatIsNoStrokeOverAGratingIsSaid) {
  EXPECT_THROW(check_rig({}, {}), Error);
  std::vector<NamedRecording> strokes = grating_strokes(1, 100, {});
  strokes[0].recording.calibration = make_uncalibrated(2048.0, 16.4, 0.01);
  const RigCheck check = check_rig(strokes, {});
  EXPECT_FALSE(check.right);
  EXPECT_THAT(codes(check), Contains("uncalibrated"));

  const std::vector<NamedRecording> smooth =
      grating_strokes(1, 100, {}, [](SimulationConfig& config) { config.surface.amplitude_m = 0.0; });
  const RigCheck none = check_rig(smooth, {});
  EXPECT_FALSE(none.right);
  EXPECT_THAT(codes(none), Contains("stroke_not_measured"));
  EXPECT_EQ(none.pitch_m.count, 0U);
}

}  // namespace
}  // namespace asperity
