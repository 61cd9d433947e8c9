#include "demo_scanner.h"

#include <fmt/format.h>

#include <string>
#include <utility>
#include <vector>

#include "asperity/base/output.h"
#include "asperity/calibration/calibrate_accelerometer_field.h"
#include "asperity/calibration/calibrate_camera.h"
#include "asperity/calibration/calibrate_imu.h"
#include "asperity/calibration/calibrate_latency.h"
#include "asperity/calibration/calibrate_tip.h"
#include "asperity/calibration/calibrate_tracker_noise.h"
#include "asperity/calibration/find_board.h"
#include "asperity/calibration/find_gyroscope_offset.h"
#include "asperity/calibration/fit_accelerometer.h"
#include "asperity/calibration/fit_force_line.h"
#include "asperity/calibration/read_accelerometer_samples.h"
#include "asperity/calibration/store_imu.h"
#include "asperity/pipeline/process_recording.h"
#include "asperity/pipeline/write_result.h"
#include "asperity/recording/write_recording.h"
#include "asperity/session/record_live.h"
#include "asperity/simulation/board_poses.h"
#include "asperity/simulation/calibration_motion.h"
#include "asperity/simulation/force_steps.h"
#include "asperity/simulation/live_bench.h"
#include "asperity/simulation/render_board.h"
#include "asperity/simulation/stamp_delay.h"
#include "asperity/tracking/track_body.h"
#include "demo_metric.h"

namespace asperity::app {

namespace {

namespace fs = std::filesystem;

// The bench, what is known of it so far, and what has been printed.
struct Rig {
  fs::path folder;
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
Recording simulate_motion(const Rig& rig, const MotionFunction& motion, double duration_s, const char* object,
                          const Observer& observer) {
  const SimulationConfig config = rig.in_the_air();
  Recording recording = simulate_motion(config, motion, duration_s, object, observer);
  add_bench_camera(recording, rig.live);
  return recording;
}

TrackerStream track_motion(const Rig& rig, const Recording& recording, double rate_Hz, std::int64_t seed,
                           const Observer& observer) {
  SimulatedCameraConfig config = rig.live.camera;
  config.rate_Hz = rate_Hz;
  config.seed = seed;
  BenchCamera camera(config, recording.calibration.markers, recording, recording.calibration.tracker.latency_s,
                     rig.live.stamp_jitter_s);
  BodyTracker tracker(rig.calibration.camera.value(), rig.calibration.markers);
  return track_frames(camera, tracker, observer);
}

void calibrate_the_camera(Rig& rig, const Observer& observer) {
  constexpr int kImages = 25;  // seed §3.5
  const SimulatedBoard drawn;
  CalibrationBoard board;
  board.columns = drawn.columns;
  board.rows = drawn.rows;
  board.square_m = drawn.square_m;
  BoardRenderer renderer(rig.live.camera, drawn);
  fs::create_directories(rig.folder / "boards");
  std::vector<BoardView> views;
  GrayImage image;
  for (const Pose& T_world_board : board_poses(rig.live.camera, drawn, kImages, 1)) {
    observer.update("camera", static_cast<double>(views.size()) / kImages);
    renderer.render(T_world_board, views.size(), image);
    const std::string name = fmt::format("board_{:02}.pgm", views.size());
    std::string bytes = fmt::format("P5\n{} {}\n255\n", image.width, image.height);
    bytes.append(image.pixels.begin(), image.pixels.end());
    write_file(rig.folder / "boards" / name, bytes);
    if (auto view = find_board(image, board)) {
      view->name = name;
      views.push_back(std::move(*view));
    }
  }
  const CameraFit fit = calibrate_camera(views, image.width, image.height);
  rig.calibration.camera = fit.camera;
  rig.judge("camera", fit.verdict);
  const CameraVector truth = camera_parameters(camera_truth(rig.live.camera));
  const CameraVector found = camera_parameters(fit.camera);
  constexpr const char* kUnits[] = {"px", "px", "px", "px", "", "", "", "", ""};
  std::vector<DemoMetric> metrics;
  for (std::size_t i = 0; i < 8; ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    metrics.push_back({kCameraParameterNames[i].data(), kCameraParameterNames[i].data(), kUnits[i], 1.0, found[k],
                       fit.standard_error[k], DemoMetric::kNone, truth[k]});
  }
  rig.add("camera", fmt::format("camera: {} images of a checkerboard", views.size()), metrics);
}

void measure_the_trackers_noise(Rig& rig, const Observer& observer) {
  constexpr double kRest_s = 6.0;
  constexpr double kRate_Hz = 40.0;
  const Pose T_world_marker{exp_rotation({0.2, 0.1, 0.05}), {0.0, -0.03, 0.32}};
  const Recording rest =
      simulate_motion(rig, static_motion(T_world_marker, rig.tip_in_marker_m()), kRest_s, "rest", observer);
  const TrackerStream poses = track_motion(rig, rest, kRate_Hz, 1, observer);
  const TrackerStream others = track_motion(rig, rest, kRate_Hz, 2, observer);
  const auto measure = [&](const TrackerStream& stream) {
    const StaticTracker resting{"rest", &stream, rig.calibration.markers, true};
    return calibrate_tracker_noise({&resting, 1});
  };
  const TrackerNoise noise = measure(poses);
  const TrackerNoise other = measure(others);
  rig.calibration.tracker.sigma_position_m = noise.sigma_position_m;
  rig.calibration.tracker.sigma_rotation_rad = noise.sigma_rotation_rad;
  rig.judge("tracker", noise.verdict);
  std::vector<DemoMetric> metrics;
  constexpr const char* kKeys[] = {"sigma_x_m", "sigma_y_m", "sigma_z_m"};
  constexpr const char* kTitles[] = {"noise x", "noise y", "noise z"};
  constexpr const char* kTurnKeys[] = {"sigma_rx_rad", "sigma_ry_rad", "sigma_rz_rad"};
  constexpr const char* kTurnTitles[] = {"noise about x", "noise about y", "noise about z"};
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    metrics.push_back({kKeys[axis], kTitles[axis], "µm", 1e6, noise.sigma_position_m[axis],
                       noise.sigma_position_error_m[axis], DemoMetric::kNone, other.sigma_position_m[axis]});
  }
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    metrics.push_back({kTurnKeys[axis], kTurnTitles[axis], "mrad", 1e3, noise.sigma_rotation_rad[axis],
                       noise.sigma_rotation_error_rad[axis], DemoMetric::kNone, other.sigma_rotation_rad[axis]});
  }
  rig.add("tracker", fmt::format("tracker at rest: {} poses (true: as many others)", poses.size()), metrics);
}

void calibrate_the_force(Rig& rig, const Observer& observer) {
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

void calibrate_the_accelerometer(Rig& rig, const Observer& observer) {
  StaticPosesMotion poses;
  poses.poses = 36;
  poses.hold_s = 1.4;
  poses.move_s = 0.5;
  const Recording bench = simulate_motion(rig, static_poses_motion(poses, rig.tip_in_marker_m()), poses.duration_s(),
                                          "static poses", observer);
  const auto [received, description] = through_link(bench, rig.simulation.probe);
  const AccelerometerSamples samples = accelerometer_samples_of(received).samples;
  const AccelerometerFieldResult field = calibrate_accelerometer_field(samples);
  rig.judge("accelerometer in the field", field.verdict);
  const AccelerometerCalibration& truth = bench.calibration.accelerometer;
  std::vector<DemoMetric> metrics;
  constexpr const char* kScaleKeys[] = {"scale_i", "scale_j", "scale_k"};
  constexpr const char* kScaleTitles[] = {"scale i", "scale j", "scale k"};
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    metrics.push_back({kScaleKeys[axis], kScaleTitles[axis], "counts per m/s²", 1.0, field.scale_counts_per_mps2[axis],
                       field.scale_stderr[axis], DemoMetric::kNone, truth.B.row(axis).norm()});
  }
  rig.add("accelerometer_field", fmt::format("accelerometer from gravity alone: {} poses", field.used), metrics);

  // On a tilting table, which knows how it stands: the sensor's rotation to the marker comes with it.
  const std::vector<Eigen::Vector3d> force_mps2 = static_specific_force_mps2(bench, received.probe.t_ns);
  AccelerometerSamples still;
  for (const FieldPose& pose : field.poses) {
    for (std::size_t i = pose.pose.first; i < pose.pose.last; ++i) {
      still.t_s.push_back(samples.t_s[i]);
      still.counts.push_back(samples.counts[i]);
      still.specific_force_mps2.push_back(force_mps2[i]);
    }
  }
  const AccelerometerFit fit = fit_accelerometer(still);
  rig.judge("accelerometer", fit.verdict);
  rig.calibration.accelerometer = fit.accelerometer;
  metrics.clear();
  constexpr const char* kKeys[] = {"B_ix", "B_jy", "B_kz", "C_i", "C_j", "C_k"};
  constexpr const char* kTitles[] = {"B i x", "B j y", "B k z", "C i", "C j", "C k"};
  const auto with_error = [&](std::size_t name, Eigen::Index row, Eigen::Index column, double found, double wanted) {
    metrics.push_back({kKeys[name], kTitles[name], name < 3 ? "counts per m/s²" : "counts", 1.0, found,
                       fit.accelerometer.standard_errors(row, column), DemoMetric::kNone, wanted});
  };
  for (Eigen::Index axis = 0; axis < 3; ++axis)
    with_error(static_cast<std::size_t>(axis), axis, axis, fit.accelerometer.B(axis, axis), truth.B(axis, axis));
  for (Eigen::Index axis = 0; axis < 3; ++axis)
    with_error(static_cast<std::size_t>(axis) + 3, axis, fit.accelerometer.B.cols(), fit.accelerometer.C[axis],
               truth.C[axis]);
  rig.add("accelerometer", fmt::format("accelerometer on a tilting table: {} poses", fit.poses), metrics);

  // The data sheet's scale and the offset at rest.
  std::vector<StaticPose> rests;
  for (const FieldPose& pose : field.poses) rests.push_back(pose.pose);
  if (const auto offset = find_gyroscope_offset(received, rests)) {
    rig.calibration.gyroscope =
        GyroscopeCalibration{description.gyro_counts_per_radps * Eigen::Matrix3d::Identity(), offset->counts};
    metrics.clear();
    constexpr const char* kGyroKeys[] = {"offset_i", "offset_j", "offset_k"};
    constexpr const char* kGyroTitles[] = {"offset i", "offset j", "offset k"};
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      metrics.push_back({kGyroKeys[axis], kGyroTitles[axis], "counts", 1.0, offset->counts[axis],
                         offset->stderr_counts[axis], DemoMetric::kNone, bench.calibration.gyroscope->C[axis]});
    }
    rig.add("gyroscope", "gyroscope at rest", metrics);
  }
}

void calibrate_the_tip(Rig& rig, const Observer& observer) {
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

LiveRecording record_scan(const Rig& rig, const Recording& scan, const char* name, const Observer& observer) {
  return record_live(scan, rig.simulation.probe, rig.live, rig.calibration, rig.folder / name, observer);
}

// From the shaking: where the inertial sensor is on the probe, then by its accelerations the latency.
void calibrate_the_imu(Rig& rig, const Recording& scan, const LiveRecording& live) {
  const ImuCalibration imu = calibrate_imu(live.recording);
  store_imu(imu, live.recording.calibration, rig.calibration);
  rig.judge("inertial sensor", imu.verdict);
  const Eigen::Vector3d truth_m = scan.calibration.accelerometer_in_marker_m();
  constexpr const char* kKeys[] = {"accelerometer_x_m", "accelerometer_y_m", "accelerometer_z_m"};
  constexpr const char* kTitles[] = {"accelerometer x", "accelerometer y", "accelerometer z"};
  std::vector<DemoMetric> metrics;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    metrics.push_back({kKeys[axis], kTitles[axis], "mm", 1e3, imu.accelerometer_in_marker_m[axis],
                       imu.position_error_m[axis], DemoMetric::kNone, truth_m[axis]});
  }
  rig.add("imu", fmt::format("inertial sensor: its place on the probe, shaken live, {} poses", imu.poses), metrics);
}

void calibrate_the_latency(Rig& rig, const Observer& observer) {
  ShakeMotion shake;
  const Recording scan = simulate_motion(rig, shake_motion(shake, rig.tip_in_marker_m()), 7.0, "shaken", observer);
  LiveRecording live = record_scan(rig, scan, "shaken", observer);
  calibrate_the_imu(rig, scan, live);
  live.recording.calibration = rig.calibration;
  // The accelerometer is calibrated; of the gyroscope only the data sheet and the offset are known.
  LatencyConfig config;
  config.method = LatencyMethod::kAccelerometer;
  const LatencyFit fit = calibrate_latency(live.recording, config);
  // Against the accelerometer's rows as they are stamped: later than the motion by its low-pass and by what the link
  // needs.
  const double wanted_s =
      scan.calibration.tracker.latency_s - live.stamp_delay_s - accelerometer_delay_s(rig.in_the_air());
  rig.calibration.tracker.latency_s = fit.latency_s;
  rig.calibration.tracker.latency_sigma_s = fit.latency_error_s;
  rig.judge("latency", fit.verdict);
  rig.add("latency",
          fmt::format(
              "latency: shaken live, {} poses (true: camera {:.3g} ms, less stamps {:.3g} ms, its low-pass {:.3g} ms)",
              fit.poses, 1e3 * scan.calibration.tracker.latency_s, 1e3 * live.stamp_delay_s,
              1e3 * accelerometer_delay_s(rig.in_the_air())),
          {{"latency_s", "latency", "ms", 1e3, fit.latency_s, fit.latency_error_s, DemoMetric::kNone, wanted_s}});
}

void scan_the_protoboard(Rig& rig, const ProcessConfig& process, const Observer& observer) {
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
  Rig rig;
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
