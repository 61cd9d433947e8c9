// A probe of your own: arrays of samples and poses become a Recording, and go through the same stages.
// The arrays stand for what a sensor would give: a tip drawn over waves of 2 mm pitch and 0.1 mm depth.

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <numbers>

#include "asperity/base/random.h"
#include "asperity/pipeline/process_recording.h"
#include "asperity/recording/validate_recording.h"

namespace {

constexpr double kPitch_m = 2e-3;
constexpr double kAmplitude_m = 0.05e-3;
constexpr double kDuration_s = 4.0;
constexpr double kCountsPer_mps2 = 400.0;
constexpr double kNewtonPerCount = 0.001;

// The tip in a world whose z axis points up; it starts from rest.
Eigen::Vector3d p_world_tip_at(double t_s) {
  const double x_m = 0.02 * (t_s - 0.3 * (1.0 - std::exp(-t_s / 0.3)));
  return {x_m, 0.0, kAmplitude_m * std::sin(2.0 * std::numbers::pi * x_m / kPitch_m)};
}

Eigen::Vector3d a_world_tip_at(double t_s) {
  constexpr double kStep_s = 1e-4;
  return (p_world_tip_at(t_s + kStep_s) - 2.0 * p_world_tip_at(t_s) + p_world_tip_at(t_s - kStep_s)) /
         (kStep_s * kStep_s);
}

std::int64_t to_ns(double t_s) { return std::llround(1e9 * t_s); }

asperity::Recording record() {
  asperity::Recording recording;
  recording.info.object = "waves";
  recording.info.world = "z_up";
  recording.info.gravity_world_mps2 = {0.0, 0.0, -9.80665};
  recording.info.probe_rate_Hz = 1000.0;
  recording.info.tracker_rate_Hz = 100.0;
  recording.info.adc_min = -32768.0;
  recording.info.adc_max = 32767.0;

  // How counts become m/s² and N, where the tip is on the body that the tracker sees, and how well it sees.
  asperity::Calibration& calibration = recording.calibration;
  calibration.accelerometer.B = kCountsPer_mps2 * Eigen::Matrix3d::Identity();
  calibration.force.newton_per_count = kNewtonPerCount;
  calibration.tip_in_marker_m = {0.0, 0.0, -0.1};
  calibration.tracker.sigma_position_m = {0.1e-3, 0.1e-3, 0.1e-3};
  calibration.tracker.sigma_rotation_rad = {1e-3, 1e-3, 1e-3};

  // Raw counts, in rising time. This probe does not turn, so the marker frame is parallel to the world.
  asperity::Random random(1);
  for (int i = 0; i < 1000 * static_cast<int>(kDuration_s); ++i) {
    const double t_s = 1e-3 * i;
    const Eigen::Vector3d f_mps2 = a_world_tip_at(t_s) - recording.info.gravity_world_mps2;
    const Eigen::Vector3d noise_counts(8.0 * random.normal(), 8.0 * random.normal(), 8.0 * random.normal());
    recording.probe.t_ns.push_back(to_ns(t_s));
    recording.probe.accel_counts.push_back((kCountsPer_mps2 * f_mps2 + noise_counts).array().round());
    recording.probe.force_counts.push_back(std::round((1.0 + 0.01 * random.normal()) / kNewtonPerCount));
  }
  for (int i = 0; i < 100 * static_cast<int>(kDuration_s); ++i) {
    const double t_s = 1e-2 * i;
    const Eigen::Vector3d noise_m(1e-4 * random.normal(), 1e-4 * random.normal(), 1e-4 * random.normal());
    recording.tracker.t_ns.push_back(to_ns(t_s));
    recording.tracker.T_world_marker.push_back(
        {Eigen::Quaterniond::Identity(), p_world_tip_at(t_s) - calibration.tip_in_marker_m + noise_m});
  }
  return recording;
}

}  // namespace

int main() try {
  const asperity::Recording recording = record();
  asperity::validate_recording(recording);  // says which array breaks which rule
  const asperity::ProcessResult result = asperity::process_recording(recording, {});
  for (const asperity::Problem& problem : result.problems) std::printf("note: %s\n", problem.message.c_str());
  if (!result.periodicity.periodic) return 1;

  const asperity::Periodicity& waves = result.periodicity;
  std::printf("%-8s %18s %10s\n", "", "measured", "true");
  std::printf("%-8s %10.4f ± %.4f %10.4f mm\n", "pitch", 1e3 * waves.pitch_m, 1e3 * waves.pitch_stderr_m,
              1e3 * kPitch_m);
  std::printf("%-8s %10.1f ± %.1f %10.1f µm\n", "depth", 1e6 * waves.depth_m, 1e6 * waves.depth_stderr_m,
              2e6 * kAmplitude_m);
  return result.trustworthy ? 0 : 3;
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
