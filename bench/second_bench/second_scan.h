#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

// A second simulator of scans, written from docs/recording.md and the recording format alone, with other physics than
// modules/simulation and nothing of it: docs/second-bench.md. Lengths in m, times in s, forces in N.
namespace second_bench {

enum class Contact { kHuntCrossley, kKelvinVoigt };

// All that is drawn of one scan.
struct ScanPlan {
  std::uint64_t seed = 0;
  std::string family;  // one of families()
  bool open = true;    // the open probe; else the seed's: 8 bit, 400 Hz, one pole, no gyroscope

  // The object. Relief over (along, across); see make_relief().
  double pitch_m = std::numeric_limits<double>::quiet_NaN();
  double height_m = 0.0;  // amplitude, depth, RMS: as the family has it
  double low_cycles_per_mm = 0.2, high_cycles_per_mm = 3.0, slope = 1.5;
  double radius_m = 0.0;  // of the cylinder; 0 for a plane
  Eigen::Vector3d centre_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ(), along = Eigen::Vector3d::UnitX();

  // The contact.
  double tip_radius_m = 0.32e-3;
  Contact contact = Contact::kHuntCrossley;
  double contact_stiffness = 0.0;  // N/m^1.5 or N/m
  double contact_damping = 0.0;    // s/m or N s/m
  double friction_static = 0.25, friction_sliding = 0.2;

  // The hand.
  double speed_mps = 0.025, length_m = 0.08, speed_variation = 0.1;
  double rest_before_s = 0.5, rest_after_s = 0.5;
  double rest_middle_s = 0.0;  // 0: none
  double approach_s = 0.0;     // comes down out of the air at first; 0: touches from the beginning
  double force_from_N = 0.8, force_to_N = 0.8, force_variation = 0.1;
  double probe_mass_kg = 0.035, hand_mass_kg = 0.2;
  double grip_N_per_m = 1500.0, grip_N_s_per_m = 4.0, arm_N_per_m = 250.0, arm_N_s_per_m = 12.0;
  double tremor_N = 0.1, tremor_Hz = 9.5;
  double lateral_m = 0.05e-3, turn_rad = 0.02, follow_normal = 0.7;
  Eigen::Vector3d tilt_rad = Eigen::Vector3d::Zero();

  // The probe.
  Eigen::Vector3d tip_in_marker_m = Eigen::Vector3d::Zero(), sensor_in_marker_m = Eigen::Vector3d::Zero();
  double rate_Hz = 2000.0, nominal_rate_Hz = 2000.0;
  double adc_min = -32768.0, adc_max = 32767.0;
  double accel_counts_per_g = 2048.0, accel_noise_mps2_per_rtHz = 7e-4, accel_flicker_mps2 = 2e-3,
         accel_drift_mps2 = 5e-3;
  double filter_Hz = 700.0, filter_q = 0.7, resonance_Hz = 4000.0, resonance_q = 2.0;
  double gyro_noise_radps_per_rtHz = 6e-5, gyro_flicker_radps = 3e-4;
  double force_rate_Hz = 320.0, force_noise_N = 0.005, force_filter_Hz = 120.0, force_newton_per_count = 3e-4;
  double tip_mass_kg = 3e-3;  // between the tip and the force sensor
  double batch_s = 0.0;       // samples come in batches of this length; 0: each with a stamp of its own
  double stamp_jitter_s = 20e-6, stamp_step_s = 0.0;
  double lost_chance = 0.0, spike_chance = 0.0;

  // The tracker.
  double frame_rate_Hz = 100.0, latency_s = 0.015, frame_jitter_s = 0.2e-3;
  double noise_across_m = 0.1e-3, noise_along_m = 0.4e-3, noise_tilt_rad = 3e-3, noise_about_rad = 1e-3;  // at 0.3 m
  double slow_share = 0.3, slow_time_s = 1.0;  // a Gauss–Markov error, as a share of the frame's
  double lost_frames = 0.005, outlying_frames = 0.005, flipped_frames = 0.002;
  bool states_frame_sigmas = false;

  // How wrong the calibration is: standard deviations, which it states.
  double accel_scale_error = 2e-3, accel_offset_error_mps2 = 0.03, gyro_scale_error = 2e-3,
         gyro_offset_error_radps = 1e-3;
  double force_scale_error = 0.01, force_offset_error_N = 0.01;
  double tip_error_m = 0.1e-3, sensor_place_error_m = 0.3e-3, latency_error_s = 2e-3, gravity_error_rad = 1e-3;
  double sigma_error = 0.1;
};

const std::vector<std::string>& families();

// A random plan; the same seed gives the same plan. `family` and `probe` ("open", "what") empty: drawn too.
ScanPlan draw_plan(std::uint64_t seed, const std::string& family = {}, const std::string& probe = {});

// Stiffness of the contact (dF/d indentation) at the mean of the plan's forces, N/mm.
double tangent_stiffness_N_per_mm(const ScanPlan& plan);

// Runs the plan and writes the recording's five files into `folder`, which is made. The same plan gives the same
// bytes. Throws std::runtime_error if it cannot write.
void write_scan(const ScanPlan& plan, const std::filesystem::path& folder);

}  // namespace second_bench
