#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "asperity/base/progress.h"
#include "asperity/calibration/calibration_verdict.h"
#include "asperity/recording/recording.h"
#include "asperity/session/record_live.h"
#include "asperity/simulation/calibration_motion.h"
#include "asperity/simulation/live_bench.h"
#include "demo_metric.h"
#include "demo_scanner.h"

namespace asperity::app {

// The bench, what is known of it so far, and what has been printed.
struct DemoRig {
  std::filesystem::path folder;
  SimulationConfig simulation;
  LiveBenchConfig live;
  Calibration calibration;
  ScannerDemo demo;

  void add(const std::string& key, const std::string& title, const std::vector<DemoMetric>& metrics) {
    demo.json[key] = metrics_json(metrics);
    demo.text += title + "\n";
    for (const DemoMetric& metric : metrics) demo.text += metric_line(metric);
  }
  void judge(const std::string& what, const CalibrationVerdict& verdict) {
    if (verdict.trustworthy) return;
    demo.trustworthy = false;
    demo.verdict += (demo.verdict.empty() ? "" : "; ") + what + ": " + verdict.text;
  }
  // There is no contact to integrate.
  SimulationConfig in_the_air() const {
    SimulationConfig config = simulation;
    config.step_s = 1e-4;
    return config;
  }
  Eigen::Vector3d tip_in_marker_m() const { return Eigen::Vector3d(simulation.probe.tip_in_marker_m.data()); }
};

// A recording of the bench with its cameras' view of the tags.
Recording simulate_motion(const DemoRig& rig, const MotionFunction& motion, double duration_s, const char* object,
                          const Observer& observer);

// The tags followed in the images of it.
TrackerStream track_motion(const DemoRig& rig, const Recording& recording, double rate_Hz, std::int64_t seed,
                           const Observer& observer);

LiveRecording record_scan(const DemoRig& rig, const Recording& scan, const char* name, const Observer& observer);

// The calibrations, each into `rig.calibration` and beside the bench's truth.
void calibrate_the_camera(DemoRig& rig, const Observer& observer);
void measure_the_trackers_noise(DemoRig& rig, const Observer& observer);
void calibrate_the_accelerometer(DemoRig& rig, const Observer& observer);
void calibrate_the_latency(DemoRig& rig, const Observer& observer);

}  // namespace asperity::app
