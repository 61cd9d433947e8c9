#include "demo_scanner.h"

#include <fmt/format.h>

#include <string>
#include <vector>

#include "asperity/base/output.h"
#include "asperity/calibration/calibrate_tip.h"
#include "asperity/calibration/fit_force_line.h"
#include "asperity/pipeline/process_recording.h"
#include "asperity/pipeline/write_result.h"
#include "asperity/recording/write_recording.h"
#include "asperity/simulation/force_steps.h"
#include "demo_rig.h"

namespace asperity::app {

namespace {

namespace fs = std::filesystem;

void calibrate_the_force(DemoRig& rig, const Observer& observer) {
  const ForceSteps steps;
  const Recording bench = simulate_motion(
      rig, force_steps_motion(steps, Pose{Eigen::Quaterniond::Identity(), {0.0, -0.03, 0.32}}, rig.tip_in_marker_m()),
      steps.duration_s(), "force", observer);
  const Recording received = through_link(bench, rig.simulation.probe).recording;
  const ForceReadings readings = read_force_steps(steps, received.probe, bench.truth->t_ns.front());
  const ForceLineFit fit = fit_force_line({readings.counts, readings.force_N});
  rig.calibration.force = fit.force;
  rig.judge("force", fit.verdict);
  const ForceCalibration& truth = bench.calibration.force;
  rig.add("force", fmt::format("force: {} known forces", readings.counts.size()),
          {{"newton_per_count", "mN per count", "mN", 1e3, fit.force.newton_per_count, fit.newton_per_count_stderr,
            DemoMetric::kNone, truth.newton_per_count},
           {"offset_newton", "offset", "N", 1.0, fit.force.offset_newton, fit.offset_newton_stderr, DemoMetric::kNone,
            truth.offset_newton}});
}

void calibrate_the_tip(DemoRig& rig, const Observer& observer) {
  constexpr double kPivot_s = 20.0;
  constexpr double kRate_Hz = 30.0;
  const Recording pivot = simulate_motion(rig, pivot_motion({}), kPivot_s, "pivot", observer);
  const TrackerStream poses = track_motion(rig, pivot, kRate_Hz, 3, observer);
  const TipCalibration tip = calibrate_tip(poses, rig.calibration.tracker);
  rig.calibration.tip_in_marker_m = tip.tip_in_marker_m;
  rig.judge("tip", tip.verdict);
  const Eigen::Vector3d truth = rig.tip_in_marker_m();
  constexpr const char* kKeys[] = {"tip_x_m", "tip_y_m", "tip_z_m"};
  constexpr const char* kTitles[] = {"tip x", "tip y", "tip z"};
  std::vector<DemoMetric> metrics;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    metrics.push_back({kKeys[axis], kTitles[axis], "mm", 1e3, tip.tip_in_marker_m[axis], tip.stderr_m[axis],
                       DemoMetric::kNone, truth[axis]});
  }
  rig.add("tip", fmt::format("tip: pivoted in a dimple, {} of {} poses", tip.used, tip.poses), metrics);
}

void scan_the_protoboard(DemoRig& rig, const ProcessConfig& process, const Observer& observer) {
  const Recording scan = simulate_live_recording(rig.simulation, rig.live, observer);
  const LiveRecording live = record_scan(rig, scan, "scan", observer);
  const ProcessResult result = process_recording(live.recording, process, observer);
  fs::create_directories(rig.folder / "result");
  write_result(rig.folder / "result", result, live.recording, "scan");
  if (!result.trustworthy) rig.judge("scan", {false, result.verdict, {}});
  std::vector<DemoMetric> metrics{
      {"pitch_m", "pitch", "mm", 1e3, result.periodicity.pitch_m, result.periodicity.pitch_stderr_m, DemoMetric::kNone,
       rig.simulation.surface.pitch_m},
      {"probe_rows", "samples received", "", 1.0, static_cast<double>(live.recorder.link.samples), DemoMetric::kNone,
       DemoMetric::kNone, static_cast<double>(scan.probe.size())},
      {"lost_samples", "samples lost", "", 1.0, static_cast<double>(live.recorder.link.lost_samples), DemoMetric::kNone,
       DemoMetric::kNone, 0.0},
      {"poses", "poses", "", 1.0, static_cast<double>(live.recorder.tracking.poses), DemoMetric::kNone,
       DemoMetric::kNone, static_cast<double>(scan.tracker.size())}};
  if (result.accuracy && result.accuracy->profile) {
    metrics.push_back({"correlation", "correlation", "", 1.0, result.accuracy->profile->correlation, DemoMetric::kNone,
                       DemoMetric::kNone, 1.0});
  }
  rig.add("scan", "protoboard, scanned live", metrics);
}

}  // namespace

ScannerDemo demonstrate_scanner(const fs::path& folder, const ProcessConfig& process, const Observer& observer) {
  fs::create_directories(folder);
  DemoRig rig;
  rig.folder = folder;
  rig.simulation = without_link_faults(make_simulation_config("protoboard", "open"));
  rig.simulation.hand.rest_s = 1.0;
  rig.live.linger_s = 0.3;
  rig.calibration.markers = tag_body(rig.live);  // as they were printed
  rig.calibration.tip_radius_m = rig.simulation.contact.tip_radius_m;
  rig.demo.text = "the scanner\n";
  calibrate_the_camera(rig, observer);
  measure_the_trackers_noise(rig, observer);
  calibrate_the_force(rig, observer);
  calibrate_the_accelerometer(rig, observer);
  calibrate_the_tip(rig, observer);
  calibrate_the_latency(rig, observer);
  scan_the_protoboard(rig, process, observer);
  write_calibration(folder / "calibration.json", rig.calibration);
  return rig.demo;
}

}  // namespace asperity::app
