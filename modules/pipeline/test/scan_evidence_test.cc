#include "asperity/pipeline/scan_evidence.h"

#include <gmock/gmock.h>

#include "asperity/base/random.h"

namespace asperity {
namespace {

// Four seconds of a probe held still, and a trajectory that covers them.
struct Still {
  Recording recording;
  ProcessResult result;

  Still() {
    Random random(1);
    recording.calibration.accelerometer.B = 200.0 * Eigen::Matrix3d::Identity();
    for (int i = 0; i < 400; ++i) {
      recording.probe.t_ns.push_back(i * 10'000'000LL);
      recording.probe.accel_counts.emplace_back(random.normal(), -200.0 * 9.80665 + random.normal(), random.normal());
      recording.probe.force_counts.push_back(0.0);
      recording.tracker.t_ns.push_back(i * 10'000'000LL);
      recording.tracker.T_world_marker.push_back({Eigen::Quaterniond::Identity(), {1e-4 * random.normal(), 0.0, 0.3}});
    }
    result.trajectory.motion.t_ns = recording.probe.t_ns;
    result.trajectory.motion.p_world_tip_m.assign(400, Eigen::Vector3d(0.0, 0.0, 0.3));
  }
  ScanEvidence evidence() const { return scan_evidence(recording, result); }
};

TEST(ScanEvidence, OfAProbeHeldStill) {
  const ScanEvidence e = Still().evidence();
  EXPECT_TRUE(e.calibrated);
  EXPECT_FALSE(e.has_force);
  EXPECT_NEAR(e.force_ratio, 1.0, 0.01);
  EXPECT_NEAR(e.departure_ratio, 0.0, 1.0);
  EXPECT_DOUBLE_EQ(e.repeated_share, 0.0);
  EXPECT_EQ(e.rows_kept, 800U);
  EXPECT_EQ(e.rows_dropped, 0U);
  EXPECT_NEAR(e.recorded_s, 3.99, 1e-9);
  EXPECT_NEAR(e.used_s, 3.99, 1e-9);
  EXPECT_TRUE(std::isnan(e.accel_bias_mps2));
  EXPECT_FALSE(e.measured);
}

TEST(ScanEvidence, OfAWrongUnit) {
  Still still;
  still.recording.calibration.accelerometer.B *= 9.80665;  // counts per g taken for counts per m/s²
  EXPECT_NEAR(still.evidence().force_ratio, 1.0 / 9.80665, 1e-3);
}

TEST(ScanEvidence, OfTheTrajectorysMetrics) {
  Still still;
  still.result.trajectory.metrics = {{"accel_bias_mps2", 19.6},     {"latency_beyond_prior_s", 0.011},
                                     {"tracker_noise_ratio", 25.0}, {"poses_outlying", 30.0},
                                     {"poses_used", 70.0},          {"longest_tracker_gap_s", 0.7},
                                     {"rejected_samples", 8.0}};
  const ScanEvidence e = still.evidence();
  EXPECT_DOUBLE_EQ(e.accel_bias_mps2, 19.6);
  EXPECT_DOUBLE_EQ(e.latency_beyond_prior_s, 0.011);
  EXPECT_DOUBLE_EQ(e.tracker_noise_ratio, 25.0);
  EXPECT_EQ(e.poses_outlying, 30U);
  EXPECT_EQ(e.poses_used, 70U);
  EXPECT_DOUBLE_EQ(e.tracker_gap_s, 0.7);
  EXPECT_EQ(e.samples_rejected, 8U);
}

TEST(ScanEvidence, OfRepeatedPosesLostRowsAndShortOverlap) {
  Still still;
  still.recording.tracker.T_world_marker.assign(400, still.recording.tracker.T_world_marker[0]);
  still.recording.problems.push_back({"duplicate_time", "", 500});
  still.result.trajectory.motion.t_ns.resize(150);
  const ScanEvidence e = still.evidence();
  EXPECT_NEAR(e.repeated_share, 1.0, 0.01);
  EXPECT_EQ(e.rows_dropped, 500U);
  EXPECT_NEAR(e.used_s, 1.49, 1e-9);
}

TEST(ScanEvidence, OfStagesThatGaveNothing) {
  Still still;
  still.result.problems = {{"no_profile", "no profile: the path is too short", 1},
                           {"no_texture", "no texture: too few heights", 1}};
  const ScanEvidence e = still.evidence();
  EXPECT_TRUE(e.measured);
  EXPECT_EQ(e.no_profile, "the path is too short");
  EXPECT_EQ(e.no_texture, "too few heights");
  EXPECT_EQ(e.no_roughness, "");
}

}  // namespace
}  // namespace asperity
