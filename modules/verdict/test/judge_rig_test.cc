#include "asperity/verdict/judge_rig.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace asperity {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

// Five strokes over a grating of 2 mm and 200 µm that show what is true.
RigEvidence good_rig() {
  RigEvidence out;
  for (int i = 0; i < 5; ++i) out.strokes.push_back({"stroke", true, "", {}});
  out.measured = 5;
  out.pitch_m = out.true_pitch_m = 2e-3;
  out.depth_m = out.true_depth_m = 2e-4;
  out.pitch_deviation_m = out.depth_deviation_m = 0.0;
  out.along_rms_m = 10e-6;
  out.correlation = 0.999;
  out.latency_s = out.latency_deviation_s = out.latency_half_width_s = 0.0;
  out.calibrated_latency_s = 0.03;
  out.calibrated_latency_sigma_s = 1e-4;
  out.strokes_at_rest = 5;
  out.gravity_share = 1.0;
  out.gravity_angle_rad = 0.0;
  out.noise_ratio = 1.0;
  out.outlying_share = out.lost_share = 0.0;
  return out;
}

std::vector<std::string> codes_of(const RigEvidence& evidence) {
  std::vector<std::string> out;
  for (const Verdict& verdict : judge_rig(evidence, {})) out.push_back(verdict.code);
  return out;
}

TEST(JudgeRig, EachLimitHasItsCode) {
  EXPECT_THAT(judge_rig(good_rig(), {}), IsEmpty());
  const auto with = [](auto change) {
    RigEvidence evidence = good_rig();
    change(evidence);
    return codes_of(evidence);
  };
  EXPECT_THAT(with([](RigEvidence& e) { e.pitch_m *= 1.006; }), ElementsAre("pitch_off"));
  EXPECT_THAT(with([](RigEvidence& e) { e.pitch_m *= 1.004; }), IsEmpty());
  EXPECT_THAT(with([](RigEvidence& e) { e.depth_m *= 0.97; }), ElementsAre("depth_off"));
  EXPECT_THAT(with([](RigEvidence& e) { e.pitch_deviation_m = 0.01e-3; }), ElementsAre("pitch_scatters"));
  EXPECT_THAT(with([](RigEvidence& e) { e.depth_deviation_m = 5e-6; }), ElementsAre("depth_scatters"));
  EXPECT_THAT(with([](RigEvidence& e) { e.along_rms_m = 50e-6; }), ElementsAre("length_wanders"));
  EXPECT_THAT(with([](RigEvidence& e) { e.correlation = 0.98; }), ElementsAre("shape_off"));
  EXPECT_THAT(with([](RigEvidence& e) { e.latency_s = -2e-3; }), ElementsAre("latency_off"));
  EXPECT_THAT(with([](RigEvidence& e) { e.latency_deviation_s = 3e-3; }), ElementsAre("latency_scatters"));
  EXPECT_THAT(with([](RigEvidence& e) { e.gravity_share = 1.02; }), ElementsAre("gravity_off"));
  EXPECT_THAT(with([](RigEvidence& e) { e.gravity_angle_rad = 0.04; }), ElementsAre("gravity_tilted"));
  EXPECT_THAT(with([](RigEvidence& e) { e.noise_ratio = 2.0; }), ElementsAre("rig_tracker_noise"));
  EXPECT_THAT(with([](RigEvidence& e) { e.outlying_share = 0.06; }), ElementsAre("rig_poses_outlying"));
  EXPECT_THAT(with([](RigEvidence& e) { e.lost_share = 0.06; }), ElementsAre("rig_rows_lost"));
  EXPECT_THAT(with([](RigEvidence& e) { e.calibrated = false; }), ElementsAre("uncalibrated"));
  EXPECT_THAT(with([](RigEvidence& e) { e.calibrations_invalid = {"tip"}; }), ElementsAre("calibration_invalid"));
  EXPECT_THAT(with([](RigEvidence& e) { e.strokes[0].measured = false; }), ElementsAre("stroke_not_measured"));
  EXPECT_THAT(with([](RigEvidence& e) { e.measured = 3; }), ElementsAre("few_strokes"));
  EXPECT_THAT(with([](RigEvidence& e) { e.strokes_at_rest = 0; }), ElementsAre("gravity_unchecked"));
  EXPECT_THAT(with([](RigEvidence& e) { e.calibrations_unstated = {"tip"}; }), ElementsAre("calibration_unstated"));
  // What the grating is for has to be known; another figure that is not known is no fault.
  EXPECT_THAT(with([](RigEvidence& e) { e.depth_m = RigEvidence::kUnknown; }), ElementsAre("depth_off"));
  EXPECT_THAT(with([](RigEvidence& e) { e.correlation = RigEvidence::kUnknown; }), ElementsAre("shape_off"));
  EXPECT_THAT(with([](RigEvidence& e) { e.gravity_share = e.noise_ratio = RigEvidence::kUnknown; }), IsEmpty());
}

TEST(JudgeRig, AStrokesOwnVerdictsCount) {
  RigEvidence evidence = good_rig();
  evidence.strokes[1].name = "second";
  evidence.strokes[1].verdicts = {{"little_coverage", Severity::kInvalid, "only 12 %", "keep contact"}};
  const Verdicts verdicts = judge_rig(evidence, {});
  ASSERT_EQ(verdicts.size(), 1U);
  EXPECT_EQ(verdicts[0].code, "little_coverage");
  EXPECT_EQ(verdicts[0].message, "second: only 12 %");
  EXPECT_FALSE(is_trustworthy(verdicts));
}

TEST(JudgeRig, OneFindingExplainsAnother) {
  RigEvidence evidence = good_rig();
  evidence.pitch_m *= 1.02;
  EXPECT_THAT(judge_rig(evidence, {})[0].remedy, HasSubstr("0.9804 of the size"));
  evidence.along_rms_m = 1e-4;
  const Verdicts loose = judge_rig(evidence, {});
  ASSERT_EQ(loose.size(), 2U);
  EXPECT_EQ(loose[1].code, "pitch_off");
  EXPECT_THAT(loose[1].remedy, HasSubstr("first correct"));

  RigEvidence scale = good_rig();
  scale.depth_m *= 1.06;
  EXPECT_THAT(judge_rig(scale, {})[0].remedy, HasSubstr("measure the depth of the print"));
  scale.gravity_share = 1.06;
  EXPECT_THAT(judge_rig(scale, {})[1].remedy, HasSubstr("calibrate accel"));
}

}  // namespace
}  // namespace asperity
