#include "asperity/pipeline/find_quality_warnings.h"

#include <gmock/gmock.h>

#include "asperity/base/random.h"

namespace asperity {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

// Four seconds of a probe held still, and a trajectory that covers them.
struct Still {
  Recording recording;
  TrajectoryResult trajectory;

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
    trajectory.motion.t_ns = recording.probe.t_ns;
  }
  std::vector<std::string> warnings() const { return find_quality_warnings(recording, trajectory); }
};

TEST(FindQualityWarnings, HasNoneAboutAGoodRecording) { EXPECT_THAT(Still().warnings(), IsEmpty()); }

TEST(FindQualityWarnings, SeesAWrongUnitByGravity) {
  Still still;
  still.recording.calibration.accelerometer.B *= 9.80665;  // counts per g taken for counts per m/s²
  EXPECT_THAT(still.warnings(), ElementsAre(HasSubstr("reads 1 m/s²")));
}

TEST(FindQualityWarnings, SeesEstimatesFarFromTheirPriors) {
  Still still;
  still.trajectory.figures = {{"accel_bias_mps2", 19.6},     {"latency_prior_sigmas", 11.0},
                              {"tracker_noise_ratio", 25.0}, {"poses_outlying", 30.0},
                              {"poses_used", 70.0},          {"poses_outlying_share", 0.3},
                              {"probe_saturated_share", 0.6}};
  EXPECT_THAT(still.warnings(), ElementsAre(HasSubstr("bias"), HasSubstr("latency"), HasSubstr("25 times"),
                                            HasSubstr("30 of 100"), HasSubstr("60 %")));
}

TEST(FindQualityWarnings, SeesRepeatedPosesLostRowsAndShortOverlap) {
  Still still;
  still.recording.tracker.T_world_marker.assign(400, still.recording.tracker.T_world_marker[0]);
  still.recording.problems.push_back({"duplicate_time", "", 500});
  still.trajectory.motion.t_ns.resize(150);
  EXPECT_THAT(still.warnings(),
              ElementsAre(HasSubstr("repeats"), HasSubstr("500 of 1300"), HasSubstr("share only 1.5 s")));
}

}  // namespace
}  // namespace asperity
