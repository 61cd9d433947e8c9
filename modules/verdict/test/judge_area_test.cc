#include "asperity/verdict/judge_area.h"

#include <gmock/gmock.h>

namespace asperity {
namespace {

AreaEvidence good() {
  AreaEvidence out;
  out.strokes = 20;
  out.ties = 100;
  out.agreement = 0.9;
  out.agreement_sigma = 0.03;
  out.rms_m = 40e-6;
  out.noise_m = 5e-6;
  out.covered = 0.9;
  out.correlation_mm = 0.4;
  out.held_out_ratio = 1.0;
  return out;
}

std::string code(const AreaEvidence& evidence) {
  const Verdicts verdicts = judge_area(evidence);
  return verdicts.empty() ? "" : verdicts.front().code;
}

TEST(JudgeArea, NamesWhatIsWrong) {
  EXPECT_EQ(code(good()), "");
  const auto with = [](auto change) {
    AreaEvidence e = good();
    change(e);
    return code(e);
  };
  EXPECT_EQ(with([](AreaEvidence& e) { e.registered = false; }), "area_unregistered");
  EXPECT_EQ(with([](AreaEvidence& e) { e.ties = 0; }), "strokes_untied");
  EXPECT_EQ(with([](AreaEvidence& e) { e.agreement = 0.02; }), "strokes_disagree");
  EXPECT_EQ(with([](AreaEvidence& e) { e.agreement = -0.3, e.agreement_sigma = 0.5; }), "strokes_disagree");
  EXPECT_EQ(with([](AreaEvidence& e) { e.agreement_sigma = 0.6; }), "strokes_untied");
  EXPECT_EQ(with([](AreaEvidence& e) { e.agreement = 0.45, e.agreement_sigma = 0.1; }), "strokes_differ");
  EXPECT_EQ(with([](AreaEvidence& e) { e.noise_m = 30e-6; }), "area_below_noise");
  EXPECT_EQ(with([](AreaEvidence& e) { e.noise_m = AreaEvidence::kUnknown; }), "area_noise_unknown");
  EXPECT_EQ(with([](AreaEvidence& e) { e.held_out_ratio = AreaEvidence::kUnknown; }), "area_sigma_doubtful");
  EXPECT_EQ(with([](AreaEvidence& e) { e.covered = 0.3; }), "area_sparse");
  EXPECT_EQ(with([](AreaEvidence& e) { e.held_out_ratio = 2.0; }), "area_sigma_doubtful");
  EXPECT_EQ(with([](AreaEvidence& e) { e.stretch_max = 1.2; }), "area_stretched");
}

TEST(JudgeArea, WhatIsNotKnownIsNotValid) {
  AreaEvidence evidence = good();
  evidence.noise_m = evidence.covered = evidence.held_out_ratio = AreaEvidence::kUnknown;
  EXPECT_EQ(verdict_word(judge_area(evidence)), "limited");
  EXPECT_TRUE(is_trustworthy(judge_area(evidence)));
  // Strokes of which no agreement is known are not said to agree.
  evidence.agreement = evidence.agreement_sigma = AreaEvidence::kUnknown;
  EXPECT_EQ(code(evidence), "strokes_untied");
  EXPECT_THAT(judge_area(evidence).front().message, testing::Not(testing::HasSubstr("nan")));
}

}  // namespace
}  // namespace asperity
