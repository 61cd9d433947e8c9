#include <fmt/format.h>

#include <string>
#include <vector>

#include "asperity/base/output.h"
#include "asperity/calibration/calibrate_accelerometer_field.h"
#include "asperity/calibration/calibrate_imu.h"
#include "asperity/calibration/calibrate_latency.h"
#include "asperity/calibration/find_gyroscope_offset.h"
#include "asperity/calibration/fit_accelerometer.h"
#include "asperity/calibration/read_accelerometer_samples.h"
#include "asperity/calibration/store_imu.h"
#include "asperity/recording/write_recording.h"
#include "asperity/simulation/stamp_delay.h"
#include "demo_rig.h"

namespace asperity::app {

namespace {

// From the shaking: where the inertial sensor is on the probe, then by its accelerations the latency.
void calibrate_the_imu(DemoRig& rig, const Recording& scan, const LiveRecording& live) {
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
  rig.add("imu", fmt::format("inertial sensor: its position on the probe, shaken live, {} poses", imu.poses), metrics);
}

}  // namespace

void calibrate_the_accelerometer(DemoRig& rig, const Observer& observer) {
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
    rig.add("gyroscope", "stationary gyroscope", metrics);
  }
}

void calibrate_the_latency(DemoRig& rig, const Observer& observer) {
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

}  // namespace asperity::app
