#include "asperity/verdict/judge_realism.h"

#include <gtest/gtest.h>

namespace asperity {
namespace {

std::vector<std::string> codes(const RealismEvidence& evidence) {
  std::vector<std::string> out;
  for (const Verdict& verdict : judge_realism(evidence)) out.push_back(verdict.code);
  return out;
}

RealismEvidence good() {
  RealismEvidence out;
  out.score = 0.85;
  out.ceiling = 0.9;
  out.is_placed = out.has_others = out.others_agree = true;
  return out;
}

using Codes = std::vector<std::string>;

TEST(JudgeRealism, AScoreNearTheCeilingIsValid) { EXPECT_EQ(codes(good()), Codes{}); }

TEST(JudgeRealism, LowScoresAreNamed) {
  RealismEvidence evidence = good();
  evidence.score = 0.29;
  EXPECT_EQ(codes(evidence), Codes{"unlike_real"});
  evidence.score = 0.44;
  EXPECT_EQ(codes(evidence), Codes{"far_from_real"});
  evidence.score = kNan;
  EXPECT_EQ(codes(evidence), Codes{"realism_undetermined"});
}

TEST(JudgeRealism, WhatIsMissingIsNamed) {
  RealismEvidence evidence = good();
  evidence.ceiling = kNan;
  evidence.has_others = evidence.others_agree = evidence.stiffness_known = false;
  evidence.is_own = true;
  EXPECT_EQ(codes(evidence), (Codes{"own_stroke", "stiffness_assumed", "ceiling_undetermined"}));
  EXPECT_TRUE(is_trustworthy(judge_realism(evidence)));

  evidence = good();
  evidence.ceiling = kNan;
  EXPECT_EQ(codes(evidence), Codes{"ceiling_undetermined"});
  evidence = good();
  evidence.others_agree = false;
  EXPECT_EQ(codes(evidence), Codes{"no_common_line"});
  evidence = good();
  evidence.is_placed = false;
  EXPECT_EQ(codes(evidence), Codes{"stroke_not_on_texture"});
  // A texture without places cannot be found by them.
  evidence.no_places = "the texture repeats after 10.0 mm";
  EXPECT_EQ(codes(evidence), Codes{"texture_without_places"});
}

}  // namespace
}  // namespace asperity
