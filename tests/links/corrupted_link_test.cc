// A scan with the seed's probe over a line that damages 0.3 % of the bytes in each of three ways: what gets past the
// decoder in silence must not get past the pipeline.
#include <gmock/gmock.h>
#include <cmath>
#include <cstdio>

#include "asperity/pipeline/process_recording.h"
#include "asperity/simulation/simulate_recording.h"
#include "what_recording.h"

namespace asperity {
namespace {

struct Scan {
  const char* surface;
  std::uint64_t seed;
  bool pitch_is_within_reach;
};

class CorruptedLink : public testing::TestWithParam<Scan> {};

TEST_P(CorruptedLink, ThePipelineSurvivesWhatTheDecoderCannotSee) {
  const Recording sent = simulate_recording(faultless_what_config(GetParam().surface, GetParam().seed));
  const LineResult clean = through_what_line(sent, {}, 1);
  testkit::WhatLineConfig line;
  line.corruption = {0.003, 0.003, 0.003};
  const LineResult damaged = through_what_line(sent, line, 1);

  EXPECT_GE(clean.recording.probe.size() + 10, sent.probe.size());
  EXPECT_EQ(clean.statistics.lost_frames, 0u);
  EXPECT_GT(damaged.statistics.resyncs, 10u);
  EXPECT_GT(damaged.recording.probe.size(), sent.probe.size() * 92 / 100);

  const ProcessConfig config;
  const ProcessResult of_clean = process_recording(clean.recording, config);
  const ProcessResult of_damaged = process_recording(damaged.recording, config);
  ASSERT_TRUE(of_clean.accuracy && of_clean.accuracy->profile && of_damaged.accuracy && of_damaged.accuracy->profile);
  std::printf(
      "pitch, mm: clean %.4f, damaged %.4f; profile against the truth: correlation %.4f and %.4f, RMS %.1f and %.1f "
      "µm\n",
      1e3 * of_clean.periodicity.pitch_m, 1e3 * of_damaged.periodicity.pitch_m, of_clean.accuracy->profile->correlation,
      of_damaged.accuracy->profile->correlation, of_clean.accuracy->profile->rms_um,
      of_damaged.accuracy->profile->rms_um);
  EXPECT_GT(of_damaged.accuracy->profile->correlation, of_clean.accuracy->profile->correlation - 0.1);
  // On the board this probe of 8 bits and ±2 g loses the pitch in some strokes that came through unharmed
  // (docs/probe-links.md): there the pitch says nothing of the link.
  if (!GetParam().pitch_is_within_reach) return;
  EXPECT_TRUE(of_damaged.periodicity.periodic);
  EXPECT_NEAR(of_damaged.periodicity.pitch_m, of_clean.periodicity.pitch_m, 0.02e-3);
}

INSTANTIATE_TEST_SUITE_P(Scans, CorruptedLink,
                         testing::Values(Scan{"sine", 1, true}, Scan{"sine", 2, true}, Scan{"sine", 3, true},
                                         Scan{"protoboard", 1, true}));

}  // namespace
}  // namespace asperity
