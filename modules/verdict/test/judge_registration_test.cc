#include "asperity/verdict/judge_registration.h"

#include <gmock/gmock.h>

namespace asperity {
namespace {

// A pose that stands out of eleven others, known to 0.1 mm, on a mesh of the right size.
PoseEvidence good_pose() {
  PoseEvidence out;
  out.points = 100;
  out.sigma_m = 0.1e-3;
  out.sigma_rad = 2e-3;
  out.slow_ratio = 1.0;
  out.outlying = 0.0;
  out.chance = 1e-3;
  out.mesh_scale = 1.0;
  out.mesh_scale_sigma = 2e-3;
  out.mesh_scale_gain = 0.5;
  return out;
}

TEST(JudgeRegistration, NamesWhatIsWrongWithAPose) {
  PoseEvidence evidence = good_pose();
  evidence.points = 100;
  evidence.outliers = 50;
  evidence.iterations = 1;
  EXPECT_TRUE(judge_registration(evidence).empty());

  evidence.outliers = 51;
  evidence.converged = false;
  evidence.ambiguous = true;
  evidence.rival_distance_m = 0.0415;
  evidence.rival_rotation_rad = 3.0;
  const Verdicts verdicts = judge_registration(evidence);
  ASSERT_EQ(verdicts.size(), 3U);
  EXPECT_EQ(verdicts[0].code, "pose_not_converged");
  EXPECT_THAT(verdicts[0].message, testing::HasSubstr("in 1 iteration"));
  EXPECT_EQ(verdicts[1].code, "off_mesh");
  EXPECT_THAT(verdicts[1].message, testing::HasSubstr("only 49 %"));
  EXPECT_EQ(verdicts[2].code, "pose_ambiguous");
  EXPECT_THAT(verdicts[2].remedy, testing::HasSubstr("refinement.guess_sigma_m"));
  EXPECT_THAT(verdicts[2].message, testing::HasSubstr("41.5 mm and 171.9 degrees"));
  EXPECT_FALSE(is_trustworthy(verdicts));
}

TEST(JudgeRegistration, RefusesAPathThatIsPartlyInTheAir) {
  PoseEvidence evidence = good_pose();
  evidence.off_share = 0.04;
  evidence.off_limit_m = 1.8e-3;
  evidence.off_m = 24e-3;
  EXPECT_TRUE(judge_registration(evidence).empty());
  evidence.off_share = 0.48;
  const Verdicts verdicts = judge_registration(evidence);
  ASSERT_EQ(verdicts.size(), 1U);
  EXPECT_EQ(verdicts[0].code, "off_mesh");
  EXPECT_EQ(verdicts[0].message, "48 % of the path is more than 1.8 mm from the mesh, 24 mm in the median");
  EXPECT_FALSE(is_trustworthy(verdicts));
}

TEST(JudgeRegistration, ErrorsThatNobodyStatedLimitThePose) {
  PoseEvidence evidence = good_pose();
  evidence.assumed_drift_m = 0.15e-3;
  evidence.assumed_length_m = 14e-3;
  Verdicts verdicts = judge_registration(evidence);
  ASSERT_EQ(verdicts.size(), 1U);
  EXPECT_EQ(verdicts[0].code, "errors_assumed");
  EXPECT_THAT(verdicts[0].message, testing::HasSubstr("0.15 mm RMS on each axis that lasts for 14 mm"));
  EXPECT_TRUE(is_trustworthy(verdicts));
  // Nothing says that the drift is as large as it should be: the limit for a chance is the sharper one.
  evidence.chance = 0.3;
  EXPECT_FALSE(is_trustworthy(judge_registration(evidence)));
  evidence = good_pose();
  evidence.independent_assumed = true;
  verdicts = judge_registration(evidence);
  ASSERT_EQ(verdicts.size(), 1U);
  EXPECT_THAT(verdicts[0].message, testing::HasSubstr("independent"));
}

TEST(JudgeRegistration, AStandardErrorIsNotRoundedToNothing) {
  PoseEvidence evidence = good_pose();
  evidence.mesh_scale = 0.98412;
  evidence.mesh_scale_sigma = 0.00023;
  evidence.mesh_scale_gain = 1000.0;
  EXPECT_THAT(judge_registration(evidence).front().message, testing::HasSubstr("0.98412 ± 0.00023"));
}

TEST(JudgeRegistration, RefusesAResidualThatNoErrorExplains) {
  PoseEvidence evidence = good_pose();
  evidence.points = 100;
  evidence.extent_m = 0.03;
  evidence.explained_m = 0.1e-3;
  const auto codes = [&] {
    std::vector<std::string> out;
    for (const Verdict& verdict : judge_registration(evidence)) out.push_back(verdict.code);
    return out;
  };
  evidence.slow_m = 0.45e-3;
  EXPECT_THAT(codes(), testing::IsEmpty());
  // A mesh can be wrong by that.
  evidence.slow_m = 0.55e-3;
  EXPECT_THAT(codes(), testing::ElementsAre("mesh_misfit"));
  EXPECT_TRUE(is_trustworthy(judge_registration(evidence)));
  evidence.slow_m = 6.2e-3;
  EXPECT_THAT(codes(), testing::ElementsAre("pose_misfit"));
  EXPECT_FALSE(is_trustworthy(judge_registration(evidence)));
  // A relief of that height explains it.
  evidence.explained_m = 2e-3;
  EXPECT_THAT(codes(), testing::IsEmpty());
}

TEST(JudgeRegistration, RefusesAPoseFarFromAGuessOfStatedError) {
  PoseEvidence evidence = good_pose();
  evidence.points = 100;
  evidence.guess_shift_m = 15e-3;
  evidence.guess_rotation_rad = 0.2;
  evidence.guess_sigma_m = 20e-3;
  evidence.guess_sigma_rad = 0.35;
  EXPECT_TRUE(judge_registration(evidence).empty());
  evidence.guess_sigma_m = 2e-3;
  const Verdicts verdicts = judge_registration(evidence);
  ASSERT_EQ(verdicts.size(), 1U);
  EXPECT_EQ(verdicts[0].code, "guess_contradicted");
  EXPECT_THAT(verdicts[0].message, testing::HasSubstr("15 mm"));
}

TEST(JudgeRegistration, RefusesAPoseThatThePathsLeaveOpenAndOneOfAnotherShape) {
  PoseEvidence evidence = good_pose();
  evidence.points = 100;
  const auto codes = [&] {
    std::vector<std::string> out;
    for (const Verdict& verdict : judge_registration(evidence)) out.push_back(verdict.code);
    return out;
  };
  evidence.sigma_m = 0.3e-3;
  evidence.sigma_rad = 0.01;
  evidence.slow_ratio = 1.4;
  evidence.outlying = 0.02;
  EXPECT_THAT(codes(), testing::IsEmpty());
  evidence.sigma_rad = 0.09;
  EXPECT_THAT(codes(), testing::ElementsAre("pose_uncertain"));
  EXPECT_FALSE(is_trustworthy(judge_registration(evidence)));
  evidence.sigma_rad = 0.01;
  evidence.slow_ratio = 6.0;
  EXPECT_THAT(codes(), testing::ElementsAre("other_shape"));
  evidence.slow_ratio = 1.4;
  evidence.chance = 0.05;
  EXPECT_THAT(codes(), testing::IsEmpty());
  evidence.chance = 0.3;
  EXPECT_THAT(codes(), testing::ElementsAre("shape_unproven"));
  evidence.slow_ratio = 1.0;  // as near as its errors say
  EXPECT_THAT(codes(), testing::IsEmpty());
  evidence.chance = 0.7;
  EXPECT_THAT(codes(), testing::ElementsAre("shape_unproven"));
  EXPECT_FALSE(is_trustworthy(judge_registration(evidence)));
  evidence.chance = PoseEvidence::kUnknown;
  evidence.slow_ratio = 1.4;
  evidence.searched = false;
  EXPECT_THAT(codes(), testing::ElementsAre("rivals_unknown"));
  EXPECT_FALSE(is_trustworthy(judge_registration(evidence)));
}

// Each comparison with nan is false: none of them may let a pose pass.
TEST(JudgeRegistration, WhatIsNotKnownIsNeverValid) {
  const auto without = [](double PoseEvidence::*figure) {
    PoseEvidence evidence = good_pose();
    evidence.*figure = PoseEvidence::kUnknown;
    return judge_registration(evidence);
  };
  EXPECT_TRUE(judge_registration(good_pose()).empty());
  for (const auto figure :
       {&PoseEvidence::sigma_m, &PoseEvidence::sigma_rad, &PoseEvidence::slow_ratio, &PoseEvidence::outlying}) {
    EXPECT_EQ(verdict_word(without(figure)), "invalid");
  }
  EXPECT_EQ(without(&PoseEvidence::sigma_m)[0].code, "pose_uncertain");
  EXPECT_EQ(without(&PoseEvidence::slow_ratio)[0].code, "shape_unproven");
  EXPECT_EQ(verdict_word(without(&PoseEvidence::chance)), "limited");
  EXPECT_EQ(without(&PoseEvidence::mesh_scale)[0].code, "mesh_scale_unknown");
  PoseEvidence empty = good_pose();
  empty.points = 0;
  EXPECT_EQ(judge_registration(empty)[0].code, "off_mesh");
}

TEST(JudgeRegistration, RefusesAMeshThatOnlyItsErrorCouldSpeakForAndOneWhoseImageFits) {
  PoseEvidence evidence = good_pose();
  const auto codes = [&] {
    std::vector<std::string> out;
    for (const Verdict& verdict : judge_registration(evidence)) out.push_back(verdict.code);
    return out;
  };
  // Three times the stated error, and nothing to compare with.
  evidence.chance = PoseEvidence::kUnknown;
  evidence.slow_ratio = 3.3;
  evidence.slow_ratio_sigma = 0.1;
  EXPECT_THAT(codes(), testing::ElementsAre("shape_unproven"));
  evidence.chance = 0.01;
  EXPECT_THAT(codes(), testing::IsEmpty());
  // A short path does not know it well: two standard errors less, it is as stated.
  evidence.chance = PoseEvidence::kUnknown;
  evidence.slow_ratio = 1.8;
  evidence.slow_ratio_sigma = 0.2;
  EXPECT_THAT(codes(), testing::ElementsAre("shape_untested"));
  // Nearly as good at another size, and nothing else speaks for this one.
  const double scale = evidence.mesh_scale, sigma = evidence.mesh_scale_sigma, gain = evidence.mesh_scale_gain;
  evidence.mesh_scale = 0.8;
  evidence.mesh_scale_sigma = 0.02;
  evidence.mesh_scale_gain = 5.0;
  EXPECT_THAT(codes(), testing::ElementsAre("shape_unproven"));
  evidence.mesh_scale_gain = 50.0;
  EXPECT_THAT(codes(), testing::Contains("mesh_scale_differs"));
  evidence.mesh_scale_gain = 5.0;
  evidence.chance = 0.01;
  EXPECT_THAT(codes(), testing::IsEmpty());
  evidence.mesh_scale = scale;
  evidence.mesh_scale_sigma = sigma;
  evidence.mesh_scale_gain = gain;
  evidence.chance = 0.01;
  evidence.slow_ratio = 1.0;
  evidence.mirror_log_odds = -5.0;
  EXPECT_THAT(codes(), testing::IsEmpty());
  evidence.mirror_log_odds = -3.0;
  EXPECT_THAT(codes(), testing::ElementsAre("mirror_image_fits"));
  EXPECT_FALSE(is_trustworthy(judge_registration(evidence)));
}

TEST(JudgeRegistration, RefusesAMeshOfAnotherSize) {
  PoseEvidence evidence = good_pose();
  evidence.points = 100;
  const auto codes = [&](double scale, double sigma, double gain) {
    evidence.mesh_scale = scale;
    evidence.mesh_scale_sigma = sigma;
    evidence.mesh_scale_gain = gain;
    std::vector<std::string> out;
    for (const Verdict& verdict : judge_registration(evidence)) out.push_back(verdict.code);
    return out;
  };
  EXPECT_THAT(codes(1.01, 0.01, 1.0), testing::IsEmpty());
  EXPECT_THAT(codes(0.77, 0.02, 90.0), testing::ElementsAre("mesh_scale_differs"));
  EXPECT_FALSE(is_trustworthy(judge_registration(evidence)));
  EXPECT_THAT(judge_registration(evidence)[0].message, testing::HasSubstr("0.770 ± 0.015 of its size"));
  // Half a percent of mesh and tracker are allowed for.
  EXPECT_THAT(codes(1.012, 0.002, 36.0), testing::ElementsAre("mesh_scale_doubtful"));
  EXPECT_TRUE(is_trustworthy(judge_registration(evidence)));
  EXPECT_THAT(codes(1.3, 0.2, 1.0), testing::ElementsAre("mesh_scale_unknown"));
  EXPECT_EQ(verdict_word(judge_registration(evidence)), "valid");
  EXPECT_THAT(codes(PoseEvidence::kUnknown, PoseEvidence::kUnknown, PoseEvidence::kUnknown),
              testing::ElementsAre("mesh_scale_unknown"));
}

TEST(JudgeRegistration, SaysOfASymmetricMeshThatItIsOneAndTrustsThePose) {
  PoseEvidence evidence = good_pose();
  evidence.points = 100;
  evidence.symmetric_copies = 2;
  const Verdicts verdicts = judge_registration(evidence);
  ASSERT_EQ(verdicts.size(), 1U);
  EXPECT_EQ(verdicts[0].code, "mesh_symmetric");
  EXPECT_EQ(verdict_word(verdicts), "valid");
}

}  // namespace
}  // namespace asperity
