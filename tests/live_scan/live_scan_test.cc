#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

#include "asperity/pipeline/process_recording.h"
#include "asperity/session/record_live.h"
#include "asperity/simulation/calibration_motion.h"
#include "asperity/testkit/temp_dir.h"

namespace asperity {
namespace {

LiveBenchConfig slow_camera() {
  LiveBenchConfig live;
  live.camera.rate_Hz = 60.0;  // a machine that is busy with other tests keeps up
  live.linger_s = 0.3;
  live.wait_s = 120.0;
  return live;
}

// From the surface to its pitch through all that a real scan goes through: firmware, pseudo-terminal, decoder, images,
// tracker, recorder, pipeline.
TEST(LiveScan, TheProtoboardsPitchComesThrough) {
  SimulationConfig config = make_simulation_config("protoboard", "open");
  config.hand.length_m = 0.05;
  config.hand.rest_s = 0.6;
  const LiveBenchConfig live = slow_camera();
  const Recording scan = simulate_live_recording(config, live);
  const testkit::TempDir folder;
  const LiveRecording made = record_live(scan, config.probe, live, scan.calibration, folder / "scan", {});

  EXPECT_EQ(made.played.probe_bytes_lost, 0U);
  EXPECT_EQ(made.recorder.link.damaged_frames, 0U);
  EXPECT_EQ(made.recorder.link.lost_samples, 0U);
  // The last frame may still be under way when the recorder stops.
  EXPECT_GE(made.recorder.link.samples + 64, scan.probe.size());
  EXPECT_EQ(made.recorder.tracking.frames, scan.tracker.size());
  EXPECT_GE(made.recorder.tracking.poses + 2, scan.tracker.size());

  // Stamps are late by what the link needs at least, and the host's clock map is good to a fraction of a millisecond.
  EXPECT_GT(made.stamp_delay_s, -1e-3);
  EXPECT_LT(made.stamp_delay_s, 10e-3);

  // Poses against the truth at their stamps.
  double worst_m = 0.0;
  const std::int64_t latency_ns = std::llround(1e9 * scan.calibration.tracker.latency_s);
  const TrueMotion motion(made.recording);
  std::vector<double> miss_m;
  for (std::size_t i = 0; i < made.recording.tracker.size(); ++i) {
    const Pose truth = motion.T_world_marker(made.recording.tracker.t_ns[i] - latency_ns);
    miss_m.push_back((made.recording.tracker.T_world_marker[i].translation_m - truth.translation_m).norm());
    worst_m = std::max(worst_m, miss_m.back());
  }
  std::nth_element(miss_m.begin(), miss_m.begin() + static_cast<std::ptrdiff_t>(miss_m.size() / 2), miss_m.end());
  EXPECT_LT(miss_m[miss_m.size() / 2], 0.25e-3);  // what is demanded of the tracker at 0.25 to 0.6 m
  EXPECT_LT(worst_m, 3e-3);

  const ProcessResult result = process_recording(made.recording, {});
  EXPECT_TRUE(result.trustworthy) << result.verdict;
  ASSERT_TRUE(result.periodicity.periodic);
  EXPECT_NEAR(result.periodicity.pitch_m, config.surface.pitch_m, 0.01 * config.surface.pitch_m);
}

TEST(LiveScan, TheWhatsBytesComeThroughALinkWithFaults) {
  SimulationConfig config = make_simulation_config("protoboard", "what");
  config.step_s = 1e-4;
  config = without_link_faults(config);
  LiveBenchConfig live = slow_camera();
  live.camera.rate_Hz = 30.0;
  live.drop_chance = 0.003;
  live.flip_chance = 0.003;
  Recording scan =
      simulate_motion(config, shake_motion({}, Eigen::Vector3d(config.probe.tip_in_marker_m.data())), 2.0, "shaken");
  add_bench_camera(scan, live);
  const testkit::TempDir folder;
  const LiveRecording made = record_live(scan, config.probe, live, scan.calibration, folder / "scan", {});
  EXPECT_GT(made.recording.probe.size(), scan.probe.size() * 9 / 10);
  EXPECT_LE(made.recording.probe.size(), scan.probe.size() + 8);
  EXPECT_EQ(made.recorder.tracking.frames, scan.tracker.size());
}

// Unpaced, so that nothing depends on the machine: what the decoder finds is what the sensors gave.
TEST(LiveScan, TheFirmwaresBytesDecodeToTheSamples) {
  SimulationConfig config = without_link_faults(make_simulation_config("protoboard", "open"));
  config.step_s = 1e-4;
  const Recording bench =
      simulate_motion(config, shake_motion({}, Eigen::Vector3d(config.probe.tip_in_marker_m.data())), 3.0, "shaken");
  const ReceivedProbe received = through_link(bench, config.probe);
  const ProbeStream& rows = received.recording.probe;
  ASSERT_EQ(rows.size(), bench.probe.size());
  EXPECT_EQ(rows.accel_counts, bench.probe.accel_counts);
  EXPECT_EQ(rows.gyro_counts, bench.probe.gyro_counts);
  std::size_t forces = 0, sent = 0;
  for (const double force : rows.force_counts) forces += std::isnan(force) ? 0 : 1;
  for (const double force : bench.probe.force_counts) sent += std::isnan(force) ? 0 : 1;
  EXPECT_EQ(forces, sent);
  EXPECT_EQ(received.description.model, "open");
  EXPECT_NEAR(received.description.rate_Hz, 4000.0, 1e-9);
  // A host that reads every millisecond stamps to better than that.
  for (std::size_t i = 0; i < rows.size(); i += 100)
    ASSERT_NEAR(1e-9 * static_cast<double>(rows.t_ns[i] - bench.probe.t_ns[i]), 0.0, 6e-3);
}

}  // namespace
}  // namespace asperity
