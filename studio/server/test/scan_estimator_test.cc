#include "scan/scan_estimator.h"

#include <gmock/gmock.h>

#include "asperity/base/error.h"
#include "asperity/live/replay_arrivals.h"
#include "asperity/simulation/simulate_recording.h"

namespace asperity::studio {
namespace {

Recording short_scan() {
  SimulationConfig config = make_simulation_config("sine", "open");
  config.hand.length_m = 0.03;
  config.hand.speed_mps = 0.04;
  config.hand.rest_s = 0.5;
  return simulate_recording(config);
}

// All of the recording as it would have arrived; of the poses only each `stride`th.
LiveEstimate feed(ScanEstimator& estimator, const Recording& scan, std::size_t stride = 1) {
  LiveEstimate all;
  for (const ScanArrival& arrival : list_arrivals(scan)) {
    std::vector<ProbeSample> rows;
    std::vector<TrackedPose> poses;
    if (arrival.kind == ScanArrival::Kind::kRow) {
      rows.push_back(probe_sample(scan.probe, arrival.index));
    } else if (arrival.index % stride == 0) {
      poses.resize(1);
      poses[0].sample = tracker_sample(scan.tracker, arrival.index);
    }
    LiveEstimate part = estimator.take(rows, poses);
    all.tips.insert(all.tips.end(), part.tips.begin(), part.tips.end());
    all.points.insert(all.points.end(), part.points.begin(), part.points.end());
  }
  return all;
}

TEST(ScanEstimator, FollowsTheTrackedTip) {
  const Recording scan = short_scan();
  ScanEstimator estimator(scan.calibration, true, scan.info, ScanConfig{});
  const LiveEstimate all = feed(estimator, scan);
  EXPECT_GT(all.tips.size(), 150U);  // 1.75 s, every 4 ms, less the beginning
  EXPECT_GT(all.points.size(), 700U);
  EXPECT_EQ(estimator.waiting(), "");
}

TEST(ScanEstimator, TrustsNothingWhereThePosesAreTooFew) {
  const Recording scan = short_scan();
  ScanEstimator estimator(scan.calibration, true, scan.info, ScanConfig{});
  const LiveEstimate all = feed(estimator, scan, 1000);
  EXPECT_TRUE(all.tips.empty());
  EXPECT_NE(estimator.waiting(), "");
}

// The probe states its rate and its converter's range only after it was opened.
TEST(ScanEstimator, TakesWhatTheProbeSaysOfItselfLater) {
  SimulationConfig config =
      make_simulation_config("protoboard", "open");  // its edges drive the converter to its limits
  config.hand.length_m = 0.03;
  config.hand.rest_s = 0.5;
  const Recording scan = simulate_recording(config);
  ScanEstimator told(scan.calibration, true, scan.info, ScanConfig{});
  RecordingInfo bare = scan.info;
  bare.probe_rate_Hz = bare.adc_min = bare.adc_max = 0.0;
  ScanEstimator later(scan.calibration, true, bare, ScanConfig{});
  later.configure(scan.info, ScanConfig{});
  const LiveEstimate expected = feed(told, scan), found = feed(later, scan);
  ASSERT_GT(expected.points.size(), 700U);
  ASSERT_EQ(found.points.size(), expected.points.size());
  for (std::size_t i = 0; i < found.points.size(); ++i) {
    const double a = found.points[i].height_m, b = expected.points[i].height_m;
    ASSERT_TRUE(a == b || (a != a && b != b)) << i << ": " << a << " and " << b;
  }
}

TEST(ScanEstimator, KeepsItsSettingsWhenNewOnesContradict) {
  const Recording scan = short_scan();
  ScanEstimator estimator(scan.calibration, true, scan.info, ScanConfig{});
  ScanConfig bad;
  bad.live.profile.spacing_m = 1e-3;
  bad.live.profile.cutoff_cycles_per_mm = 5.0;
  EXPECT_THROW(estimator.configure(scan.info, bad), Error);
  bad = {};
  bad.hints.light_N = 50.0;
  EXPECT_THROW(estimator.configure(scan.info, bad), Error);
  estimator.restart();
  EXPECT_GT(feed(estimator, scan).points.size(), 700U);
}

}  // namespace
}  // namespace asperity::studio
