#include <gtest/gtest.h>

#include <cmath>

#include "asperity/pipeline/process_session.h"
#include "asperity/simulation/simulate_recording.h"

// A recording whose path comes back over the line that it was over before (docs/merge-lines.md).
namespace asperity {
namespace {

// Three strokes of 30 mm over sandpaper, joined by turns.
Recording strokes(double row_spacing_m) {
  SimulationConfig config = make_simulation_config("sandpaper", "open");
  config.seed = 5;
  config.hand.path = HandPathShape::kBackAndForth;
  config.hand.strokes = 3;
  config.hand.length_m = 0.03;
  config.hand.row_spacing_m = row_spacing_m;
  config.hand.lateral_wander_m = 0.0;
  return simulate_recording(config);
}

TEST(RepeatedLines, StrokesOnOneLineBecomeTheirMean) {
  ProcessSession session(strokes(0.0));
  ProcessConfig config;
  config.profile.merge_passes = false;
  const ProcessResult apart = session.process(config);
  EXPECT_TRUE(apart.lines.empty());
  const ProcessResult& merged = session.process({});  // merged unless told otherwise
  ASSERT_EQ(merged.lines.size(), 1U);
  const RepeatedLine& line = merged.lines.front();
  EXPECT_EQ(line.merged.passes.size(), 3U);
  EXPECT_EQ(line.merged.used, 3U);
  ASSERT_TRUE(line.laid) << line.reason;
  // Same points, less noise stated; bench/repeated_strokes has the errors.
  ASSERT_EQ(merged.profile.size(), apart.profile.size());
  EXPECT_LT(merged.noise.noise_rms_m, apart.noise.noise_rms_m);
}

// Rows 0.2 mm apart are near enough to be compared. That they differ says nothing against the noise they state.
TEST(RepeatedLines, RowsBesideOneAnotherContradictNoNoise) {
  ProcessSession session(strokes(0.2e-3));
  const ProcessResult& result = session.process({});
  ASSERT_FALSE(result.lines.empty());
  for (const RepeatedLine& line : result.lines) {
    EXPECT_FALSE(line.laid);
    EXPECT_FALSE(line.reason.empty());
  }
  for (const Verdict& verdict : result.verdicts) EXPECT_NE(verdict.code, "passes_disagree") << verdict.message;
}

TEST(RepeatedLines, RowsStayApart) {
  ProcessSession session(strokes(2.5e-3));
  ProcessConfig config;
  const ProcessResult merged = session.process(config);
  EXPECT_TRUE(merged.lines.empty());
  config.profile.merge_passes = false;
  const ProcessResult& apart = session.process(config);
  for (std::size_t i = 0; i < merged.profile.size(); ++i) {
    if (!std::isfinite(apart.profile.height_m[i])) continue;
    ASSERT_EQ(merged.profile.height_m[i], apart.profile.height_m[i]);
  }
}

}  // namespace
}  // namespace asperity
