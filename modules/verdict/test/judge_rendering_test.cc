#include "asperity/verdict/judge_rendering.h"

#include <gmock/gmock.h>

#include <gtest/gtest.h>
#include <cmath>

namespace asperity {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

RunEvidence good_run() {
  RunEvidence out;
  out.ticks = 1000;
  out.ticks_touching = 900;
  return out;
}

std::string line_of(const RunEvidence& evidence) {
  const Verdicts verdicts = judge_run(evidence);
  return verdicts.size() == 1 ? verdict_line(verdicts.front()) : std::to_string(verdicts.size()) + " verdicts";
}

TEST(JudgeRun, WhatRampsTheForceDownIsInvalid) {
  EXPECT_THAT(judge_run(good_run()), IsEmpty());
  RunEvidence run = good_run();
  run.device_fault = "its cable is off";
  EXPECT_THAT(line_of(run), HasSubstr("invalid: the device has a fault: its cable is off"));
  run = good_run();
  run.ticks_not_finite = 1;
  EXPECT_THAT(line_of(run), HasSubstr("invalid: the force was ramped to zero: 1 tick had numbers"));
  run = good_run();
  run.ticks_stale = 3;
  EXPECT_THAT(line_of(run), HasSubstr("invalid: the force was ramped to zero for 3 ticks"));
  run = good_run();
  run.ticks_implausible = 3;
  EXPECT_THAT(line_of(run), HasSubstr("invalid: the force was ramped to zero: on 3 ticks no hand"));
}

TEST(JudgeRun, WhatLimitsItIsSaid) {
  RunEvidence run = good_run();
  run.ticks_touching = 0;
  EXPECT_THAT(line_of(run), HasSubstr("limited: nothing was touched; "));
  run.nearest_m = 2e-3;
  EXPECT_THAT(line_of(run), HasSubstr("no nearer to a surface than 2 mm"));
  run = good_run();
  run.ticks_force_limited = 4;
  run.max_force_N = 3.0;
  EXPECT_THAT(line_of(run), HasSubstr("note: 4 ticks were limited to 3 N"));
  run = good_run();
  run.ticks_starting_inside = 4;
  EXPECT_THAT(line_of(run), HasSubstr("note: the point started inside"));
  // The worst first.
  run.ticks_unlogged = 1;
  run.ticks_stale = 1;
  std::vector<std::string> codes;
  for (const Verdict& verdict : judge_run(run)) codes.push_back(verdict.code);
  EXPECT_THAT(codes, ElementsAre("device_stale", "log_incomplete", "started_inside"));
}

TEST(JudgeRendering, APoorScoreAndAScanThatWasNotTouched) {
  EXPECT_THAT(judge_rendering({0.9, 0.5, 0.99, 0.9, "all of it"}), IsEmpty());
  const Verdicts both = judge_rendering({0.3, 0.5, 0.5, 0.9, "heights correlate by 0.4"});
  ASSERT_EQ(both.size(), 2U);
  EXPECT_EQ(both[0].code, "scan_not_rendered");
  EXPECT_EQ(both[1].code, "rendering_poor");
  EXPECT_THAT(both[1].message, HasSubstr("0.30 is poor (heights correlate by 0.4)"));
  EXPECT_FALSE(is_trustworthy(both));
  const double unknown = std::nan("");
  EXPECT_EQ(judge_rendering({unknown, 0.5, unknown, 0.9, ""}).size(), 2U);
}

}  // namespace
}  // namespace asperity
