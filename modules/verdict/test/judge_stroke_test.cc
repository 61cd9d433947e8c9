#include "asperity/verdict/judge_stroke.h"

#include <gmock/gmock.h>

namespace asperity {
namespace {

using Codes = std::vector<std::string>;

Codes codes(const StrokeEvidence& evidence) {
  Codes out;
  for (const Verdict& verdict : judge_stroke(evidence)) out.push_back(verdict.code);
  return out;
}

StrokeEvidence good() {
  StrokeEvidence out;
  out.has_speed = out.has_force = true;
  out.contact_s = out.moving_s = out.active_s = out.quiet_s = 1.0;
  out.free_s = 0.2;
  out.quiet = StrokeQuiet::kRest;
  out.power_ratio = 10.0;
  out.power_ratio_sigma = 0.5;
  out.power_ratio_chance = 1e-6;
  return out;
}

TEST(JudgeStroke, IsValidOnlyWithForceMotionAndVibration) {
  EXPECT_EQ(codes(good()), Codes{});
  EXPECT_EQ(codes(StrokeEvidence{}), (Codes{"contact_undetermined", "contact_unknown", "lengths_undetermined"}));
  StrokeEvidence e = good();
  e.contact_s = 0.1;
  EXPECT_EQ(codes(e), Codes{"nothing_touched"});
  e = good();
  e.moving_s = 0.1;
  EXPECT_EQ(codes(e), Codes{"not_moved"});
  e = good();
  e.has_force = false;
  EXPECT_EQ(codes(e), Codes{"contact_unknown"});
  e = good();
  e.free_s = 0.02;  // a force that never falls may be an offset
  EXPECT_EQ(codes(e), Codes{"force_zero_unseen"});
}

TEST(JudgeStroke, NeedsPowerAboveTheQuiet) {
  StrokeEvidence e = good();
  e.power_ratio = 1.19;
  EXPECT_EQ(codes(e), Codes{"vibration_is_noise"});
  e.power_ratio = 2.4;
  e.power_ratio_chance = 1.1 * kStrokeFalseAlarm;
  EXPECT_EQ(codes(e), Codes{"vibration_is_noise"});
  e.power_ratio_chance = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(codes(e), Codes{"vibration_is_noise"});
  e.power_ratio_chance = 0.9 * kStrokeFalseAlarm;
  EXPECT_EQ(codes(e), Codes{});
  e.power_ratio = 1.9;
  EXPECT_EQ(codes(e), Codes{"vibration_weak"});
  e.has_force = false;  // BROAD's waves in the air have 1.21 and 1.25
  EXPECT_EQ(codes(e), (Codes{"contact_undetermined", "contact_unknown"}));
  e.has_speed = false;
  e.quiet = StrokeQuiet::kQuietest;
  e.power_ratio = 3.9;
  EXPECT_EQ(codes(e), (Codes{"contact_undetermined", "contact_unknown", "lengths_undetermined"}));
  e.power_ratio = 40.0;
  e.power_ratio_chance = 0.01;
  EXPECT_EQ(codes(e), (Codes{"contact_undetermined", "contact_unknown", "lengths_undetermined"}));
}

TEST(JudgeStroke, WithoutQuietNeedsPowerThatGrowsWithTheSpeed) {
  StrokeEvidence e = good();
  e.quiet = StrokeQuiet::kNone;
  e.power_ratio = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(codes(e), Codes{"contact_undetermined"});
  e.speed_exponent = 2.0;
  e.speed_exponent_margin = 1.0;
  EXPECT_EQ(codes(e), Codes{});
  e.speed_exponent = 1.0;
  EXPECT_EQ(codes(e), Codes{"contact_undetermined"});
  e.speed_exponent = 0.0;
  e.speed_exponent_margin = 0.2;
  EXPECT_EQ(codes(e), Codes{"vibration_is_noise"});
}

}  // namespace
}  // namespace asperity
