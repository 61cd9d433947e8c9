#include "asperity/verdict/judge_recording.h"

#include <gmock/gmock.h>

#include <functional>

namespace asperity {
namespace {

RecordingEvidence good() {
  RecordingEvidence e;
  e.samples = 5000;
  e.samples_sent = 5000;
  e.rows_stored = 5000;
  e.frames = 500;
  e.poses = 500;
  e.poses_stored = 480;
  e.sources = {{"the probe", false, 0, true, ""}, {"the tracker", false, 0, true, ""}};
  e.gravity_measured = true;
  return e;
}

TEST(JudgeRecording, HasNothingAgainstAGoodOne) { EXPECT_TRUE(judge_recording(good(), {}).empty()); }

TEST(JudgeRecording, NamesEachFaultByItsCode) {
  using Evidence = RecordingEvidence;
  struct Case {
    std::string code;
    std::string message;
    std::function<void(Evidence&)> spoil;
  };
  const std::vector<Case> cases{
      {"no_samples", "(no such device)", [](Evidence& e) { e.samples = 0, e.probe_message = "no such device"; }},
      {"never_touched", "never touched", [](Evidence& e) { e.awaits_contact = true; }},
      {"nothing_stored", "nothing was stored", [](Evidence& e) { e.rows_stored = 0; }},
      {"samples_lost", "2 % of", [](Evidence& e) { e.samples_lost = 100; }},
      {"disk_too_slow", "7 samples", [](Evidence& e) { e.samples_overflowed = 7; }},
      {"disk_too_slow", "8 poses", [](Evidence& e) { e.poses_overflowed = 8; }},
      {"columns_missing", "too late", [](Evidence& e) { e.columns_missing = true; }},
      {"probe_overruns", "itself once", [](Evidence& e) { e.overruns = 1; }},
      {"sensor_faults", "not found", [](Evidence& e) { e.sensor_faults = "inertial sensor: not found"; }},
      {"no_tracker", "no tracker", [](Evidence& e) { e.has_tracker = false; }},
      {"no_poses", "no pose was found", [](Evidence& e) { e.poses = 0; }},
      {"no_poses", "the stored recording has no pose", [](Evidence& e) { e.poses_stored = 0; }},
      {"markers_hidden", "only 20 %", [](Evidence& e) { e.poses = 100; }},
      {"images_skipped", "30 images", [](Evidence& e) { e.frames_skipped = 30; }},
      {"frames_not_kept", "4 images", [](Evidence& e) { e.frames_not_kept = 4; }},
      {"source_failed", "the tracker ended by a fault: torn",
       [](Evidence& e) {
         e.sources[1] = {"the tracker", true, 0, true, "torn"};
       }},
      {"source_interrupted", "the probe disappeared 2 times",
       [](Evidence& e) {
         e.sources[0] = {"the probe", false, 2, false, ""};
       }},
      {"gravity_implausible", "another probe", [](Evidence& e) { e.gravity_implausible = true; }},
      {"gravity_assumed", "assumed", [](Evidence& e) { e.gravity_measured = false; }},
      {"no_calibration", "counts and poses only", [](Evidence& e) { e.calibrated = false; }},
  };
  for (const Case& one : cases) {
    RecordingEvidence evidence = good();
    one.spoil(evidence);
    const Verdicts verdicts = judge_recording(evidence, {});
    ASSERT_EQ(verdicts.size(), 1U) << one.code;
    EXPECT_EQ(verdicts[0].code, one.code);
    EXPECT_THAT(verdicts[0].message, testing::HasSubstr(one.message));
  }
}

}  // namespace
}  // namespace asperity
