#include "asperity/live/scan_hints.h"

#include <algorithm>
#include <cmath>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "asperity/base/error.h"
#include "asperity/live/live_profile.h"
#include "asperity/live/replay_arrivals.h"
#include "asperity/simulation/simulate_recording.h"

namespace asperity {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr std::int64_t kSecond = 1'000'000'000;

bool shows(const std::vector<Hint>& hints, HintKind kind) {
  return std::any_of(hints.begin(), hints.end(), [&](const Hint& h) { return h.kind == kind; });
}

// A scan that an advisor sees: rows at 1 kHz, poses at 100 Hz, tips at 250 Hz along x.
struct Scan {
  RecordingInfo info;
  Calibration calibration;
  double speed_mps = 0.02;
  double force_N = 1.0;
  double tilt_rad = 0.1;
  double accel_counts = 100.0;
  bool rows = true, poses = true;
  double x_m = 0.0;
  std::int64_t t_ns = kSecond;

  Scan() {
    info.probe_rate_Hz = 1000.0;
    info.tracker_rate_Hz = 100.0;
    info.adc_min = -1000.0;
    info.adc_max = 1000.0;
    calibration.force.newton_per_count = 0.01;
  }

  // Goes on for `duration_s`; the hints at the end, and how often one came or went meanwhile.
  std::vector<Hint> go(ScanAdvisor& advisor, double duration_s, int* changes = nullptr) {
    const std::int64_t end_ns = t_ns + std::llround(duration_s * 1e9);
    std::vector<Hint> hints = advisor.hints(t_ns);
    for (std::int64_t k = 0; t_ns < end_ns; ++k, t_ns += kSecond / 1000) {
      if (rows) {
        ProbeSample row;
        row.t_ns = t_ns;
        row.accel_counts.setConstant(accel_counts);
        row.force_counts = force_N / calibration.force.newton_per_count;
        advisor.push(row);
      }
      if (poses && k % 10 == 0) {
        TrackerSample pose;
        pose.t_ns = t_ns;
        advisor.push(pose);
      }
      x_m += speed_mps * 1e-3;
      if (k % 4 == 0) {
        LiveEstimate news;
        LiveTip tip;
        tip.t_ns = t_ns;
        tip.p_world_tip_m = {x_m, 0.0, 0.0};
        tip.heading_world = {speed_mps < 0.0 ? -1.0 : 1.0, 0.0, 0.0};
        tip.probe_axis_world = {std::sin(tilt_rad), 0.0, std::cos(tilt_rad)};
        tip.speed_mps = std::abs(speed_mps);
        tip.force_N = force_N;
        tip.tilt_rad = tilt_rad;
        tip.contact = force_N > 0.05;
        news.tips.push_back(tip);
        advisor.push(news);
      }
      const std::vector<Hint> now = advisor.hints(t_ns);
      if (changes != nullptr && now.size() != hints.size()) ++*changes;
      hints = now;
    }
    return hints;
  }
};

TEST(ScanAdvisor, AGoodScanGivesNoHint) {
  Scan scan;
  ScanAdvisor advisor(scan.calibration, scan.info);
  EXPECT_THAT(scan.go(advisor, 3.0), IsEmpty());
}

TEST(ScanAdvisor, TooFastNamesTheSpeedToStayBelow) {
  Scan scan;
  ScanHintsConfig config;
  config.finest_wavelength_mm = 0.1;  // at 1000 rows/s, 2.5 samples a wave: 40 mm/s
  ScanAdvisor advisor(scan.calibration, scan.info, config);
  EXPECT_NEAR(advisor.highest_speed_mps(), 0.04, 1e-12);
  scan.speed_mps = 0.06;
  const std::vector<Hint> hints = scan.go(advisor, 1.5);
  ASSERT_EQ(hints.size(), 1u);
  EXPECT_EQ(hints[0].kind, HintKind::kTooFast);
  EXPECT_THAT(hints[0].text, HasSubstr("60 mm/s"));
  EXPECT_THAT(hints[0].text, HasSubstr("below 40 mm/s"));
  EXPECT_GE(hints[0].since_ns, kSecond);
  EXPECT_LT(hints[0].since_ns, 2 * kSecond);
  scan.speed_mps = 0.02;
  EXPECT_THAT(scan.go(advisor, 4.0), IsEmpty());
}

TEST(ScanAdvisor, ForceTooLightAndTooHard) {
  Scan scan;
  ScanAdvisor advisor(scan.calibration, scan.info);
  scan.force_N = 0.2;
  EXPECT_TRUE(shows(scan.go(advisor, 2.0), HintKind::kTooLight));
  scan.force_N = 6.0;
  const auto hard = scan.go(advisor, 4.0);
  EXPECT_TRUE(shows(hard, HintKind::kTooHard));
  EXPECT_FALSE(shows(hard, HintKind::kTooLight));
  scan.force_N = 0.0;  // in the air there is nothing to say
  EXPECT_THAT(scan.go(advisor, 4.0), IsEmpty());
}

TEST(ScanAdvisor, ConvertersAtTheirLimits) {
  Scan scan;
  ScanAdvisor advisor(scan.calibration, scan.info);
  scan.accel_counts = 1000.0;
  EXPECT_TRUE(shows(scan.go(advisor, 1.0), HintKind::kAccelerometerSaturating));
  scan.accel_counts = 0.0;
  scan.force_N = 9.95;
  const auto hints = scan.go(advisor, 1.0);
  EXPECT_TRUE(shows(hints, HintKind::kForceSaturating));
  EXPECT_EQ(hints.front().severity, HintSeverity::kError) << "the gravest comes first";
}

TEST(ScanAdvisor, MarkerAndProbeThatAreGone) {
  Scan scan;
  ScanAdvisor advisor(scan.calibration, scan.info);
  scan.go(advisor, 1.0);
  scan.poses = false;
  auto hints = scan.go(advisor, 0.4);
  ASSERT_TRUE(shows(hints, HintKind::kMarkerLost));
  EXPECT_EQ(hints[0].severity, HintSeverity::kWarning);
  hints = scan.go(advisor, 0.4);
  EXPECT_EQ(hints[0].severity, HintSeverity::kError) << "no height any more";
  scan.poses = true;
  scan.rows = false;
  EXPECT_TRUE(shows(scan.go(advisor, 1.0), HintKind::kProbeSilent));
  scan.rows = true;
  EXPECT_THAT(scan.go(advisor, 4.0), IsEmpty());
}

TEST(ScanAdvisor, RowsThatAreLostButNotASlowerProbe) {
  Scan scan;
  scan.info.probe_rate_Hz = 1250.0;  // the probe gives 1000
  ScanAdvisor slower(scan.calibration, scan.info);
  EXPECT_THAT(scan.go(slower, 3.0), IsEmpty());

  ScanAdvisor advisor(scan.calibration, scan.info);
  std::vector<Hint> hints;
  for (int burst = 0; burst < 30; ++burst) {
    scan.rows = true;
    hints = scan.go(advisor, 0.09);
    scan.rows = false;
    scan.go(advisor, 0.01);  // a tenth
  }
  ASSERT_TRUE(shows(hints, HintKind::kRowsLost));
  const auto lost =
      std::find_if(hints.begin(), hints.end(), [](const Hint& h) { return h.kind == HintKind::kRowsLost; });
  EXPECT_NEAR(lost->value, 0.1, 0.05);
}

TEST(ScanAdvisor, TiltAndTurning) {
  Scan scan;
  ScanAdvisor advisor(scan.calibration, scan.info);
  scan.tilt_rad = 0.7;
  EXPECT_TRUE(shows(scan.go(advisor, 1.0), HintKind::kTiltedTooFar));
  scan.tilt_rad = 0.0;
  std::vector<Hint> hints;
  for (int k = 0; k < 100; ++k) {  // to and fro at 100 degrees/s
    scan.tilt_rad = (k / 25) % 2 == 0 ? scan.tilt_rad + 0.0175 : scan.tilt_rad - 0.0175;
    hints = scan.go(advisor, 0.01);
  }
  EXPECT_TRUE(shows(hints, HintKind::kTiltingTooFast));
}

TEST(ScanAdvisor, DoublingBackUntilTheStrokeGoesOnOrTheProbeIsLifted) {
  Scan scan;
  ScanAdvisor advisor(scan.calibration, scan.info);
  scan.go(advisor, 2.0);
  scan.speed_mps = -0.02;
  EXPECT_TRUE(shows(scan.go(advisor, 1.0), HintKind::kDoublingBack));
  scan.force_N = 0.0;
  EXPECT_THAT(scan.go(advisor, 2.5), IsEmpty());
  scan.force_N = 1.0;  // a new stroke, the other way
  EXPECT_THAT(scan.go(advisor, 2.0), IsEmpty());
  advisor.restart();
  scan.speed_mps = 0.02;
  EXPECT_THAT(scan.go(advisor, 2.0), IsEmpty());
}

TEST(ScanAdvisor, AForceAboutTheLimitDoesNotMakeTheHintFlicker) {
  Scan scan;
  ScanAdvisor advisor(scan.calibration, scan.info);
  int changes = 0;
  for (int k = 0; k < 60; ++k) {
    scan.force_N = k % 2 == 0 ? 3.8 : 4.3;  // about 4 N, ten times a second
    scan.go(advisor, 0.1, &changes);
  }
  EXPECT_LE(changes, 1);
}

TEST(ScanAdvisor, NoCalibrationIsAnError) {
  Scan scan;
  ScanAdvisor advisor(scan.calibration, scan.info, {}, false);
  const auto hints = scan.go(advisor, 0.1);
  ASSERT_FALSE(hints.empty());
  EXPECT_EQ(hints[0].kind, HintKind::kNoCalibration);
}

TEST(ScanAdvisor, RefusesLimitsThatExcludeEachOther) {
  ScanHintsConfig config;
  config.light_N = 5.0;
  EXPECT_THROW(ScanAdvisor({}, {}, config), Error);
}

TEST(ScanAdvisor, AGoodSimulatedScanGivesNoHint) {
  SimulationConfig simulation = make_simulation_config("sine", "open");
  simulation.seed = 3;
  const Recording recording = simulate_recording(simulation);
  LiveProfile live(recording.calibration, recording.info);
  ScanAdvisor advisor(recording.calibration, recording.info);
  std::int64_t next_ns = 0;
  for (const ScanArrival& arrival : list_arrivals(recording)) {
    if (arrival.kind == ScanArrival::Kind::kRow) {
      const ProbeSample row = probe_sample(recording.probe, arrival.index);
      live.push(row);
      advisor.push(row);
    } else {
      const TrackerSample pose = tracker_sample(recording.tracker, arrival.index);
      live.push(pose);
      advisor.push(pose);
    }
    if (arrival.arrival_ns < next_ns) continue;
    next_ns = arrival.arrival_ns + 20'000'000;
    advisor.push(live.estimate());
    for (const Hint& hint : advisor.hints(arrival.arrival_ns)) {
      ADD_FAILURE() << hint.text << " at " << arrival.arrival_ns;
      return;
    }
  }
}

}  // namespace
}  // namespace asperity
