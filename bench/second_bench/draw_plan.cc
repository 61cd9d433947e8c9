#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "noise_sources.h"
#include "second_scan.h"

namespace second_bench {

namespace {

void draw_object(ScanPlan& plan, Dice& dice) {
  const std::string& f = plan.family;
  if (f == "sine") {
    plan.pitch_m = dice.log_uniform(0.7e-3, 6e-3);
    plan.height_m = std::min(dice.log_uniform(5e-6, 0.15e-3), 0.3 * plan.pitch_m / (2.0 * std::numbers::pi));
  } else if (f == "sines") {
    plan.height_m = dice.log_uniform(8e-6, 60e-6);
    plan.low_cycles_per_mm = 0.2;
    plan.high_cycles_per_mm = 1.5;
  } else if (f == "ridges") {
    plan.pitch_m = dice.log_uniform(1.2e-3, 5e-3);
    plan.height_m = plan.pitch_m * dice.uniform(0.01, 0.08);
  } else if (f == "holes") {
    plan.pitch_m = dice.uniform(1.8e-3, 4e-3);
    plan.height_m = plan.pitch_m * dice.uniform(0.02, 0.12);
  } else if (f == "steps") {
    plan.pitch_m = dice.uniform(1e-3, 3e-3);
    plan.height_m = dice.log_uniform(10e-6, 60e-6);
  } else {
    plan.height_m = f == "glass"  ? dice.log_uniform(0.05e-6, 0.3e-6)
                    : f == "fine" ? dice.log_uniform(1e-6, 8e-6)
                                  : dice.log_uniform(10e-6, 60e-6);
    plan.low_cycles_per_mm = dice.log_uniform(0.15, 0.5);
    plan.high_cycles_per_mm = dice.log_uniform(1.2, 4.0);
    plan.slope = dice.uniform(0.5, 2.5);
  }
  // Steps have no one period: their plateaus' mean length is no pitch.
  plan.radius_m = dice.chance(0.3) ? dice.uniform(0.04, 0.1) : 0.0;
  plan.centre_m = {0.03 * dice.normal(), dice.uniform(0.03, 0.08), dice.uniform(0.28, 0.42)};
  const double towards_rad = dice.uniform(0.1, 0.6), roll_rad = 0.08 * dice.normal(), yaw_rad = dice.uniform(-0.6, 0.6);
  const Eigen::Quaterniond rolled(Eigen::AngleAxisd(roll_rad, Eigen::Vector3d::UnitZ()));
  plan.normal = rolled * Eigen::Vector3d(0.0, -std::cos(towards_rad), -std::sin(towards_rad));
  const Eigen::Vector3d right = (Eigen::Vector3d::UnitX() - plan.normal.x() * plan.normal).normalized();
  plan.along = Eigen::AngleAxisd(yaw_rad, plan.normal) * right;
  plan.tilt_rad = {towards_rad - 0.05 + 0.06 * dice.normal(), 0.1 * dice.normal(), roll_rad + 0.06 * dice.normal()};
}

void draw_contact(ScanPlan& plan, Dice& dice) {
  plan.tip_radius_m = dice.uniform(0.2e-3, 0.5e-3);
  const double damping_ratio = dice.uniform(0.05, 0.3);
  const double mean_N = 0.5 * (plan.force_from_N + plan.force_to_N);
  if (dice.chance(0.7)) {
    plan.contact = Contact::kHuntCrossley;
    const double modulus_Pa = dice.log_uniform(5e7, 3e9);
    plan.contact_stiffness = 4.0 / 3.0 * modulus_Pa * std::sqrt(plan.tip_radius_m);
    const double stiffness = 1e3 * tangent_stiffness_N_per_mm(plan);
    plan.contact_damping = 2.0 * damping_ratio * std::sqrt(stiffness * plan.probe_mass_kg) / mean_N;
  } else {
    plan.contact = Contact::kKelvinVoigt;
    plan.contact_stiffness = dice.log_uniform(3e3, 2e5);
    plan.contact_damping = 2.0 * damping_ratio * std::sqrt(plan.contact_stiffness * plan.probe_mass_kg);
  }
  plan.friction_sliding = dice.uniform(0.1, 0.4);
  plan.friction_static = plan.friction_sliding * dice.uniform(1.0, 1.3);
}

void draw_hand(ScanPlan& plan, Dice& dice) {
  plan.speed_mps = dice.log_uniform(12e-3, 55e-3);
  plan.length_m = std::clamp(plan.speed_mps * dice.uniform(2.2, 4.0), 0.04, 0.13);
  if (plan.radius_m > 0.0) plan.length_m = std::min(plan.length_m, 1.4 * plan.radius_m);
  plan.speed_variation = dice.uniform(0.05, 0.2);
  plan.rest_before_s = dice.chance(0.2) ? dice.uniform(2.0, 4.0) : dice.uniform(0.2, 1.0);
  plan.rest_after_s = dice.uniform(0.2, 1.0);
  if (dice.chance(0.25)) plan.rest_middle_s = dice.uniform(0.5, 2.0);
  if (dice.chance(0.35)) plan.approach_s = dice.uniform(0.6, 1.2);
  plan.force_from_N = plan.force_to_N = dice.uniform(0.5, 1.5);
  if (dice.chance(0.35)) {
    plan.force_from_N = dice.uniform(0.3, 0.6);
    plan.force_to_N = dice.uniform(1.2, 3.0);
  }
  plan.force_variation = dice.uniform(0.05, 0.15);
  plan.probe_mass_kg = dice.uniform(0.025, 0.06);
  plan.hand_mass_kg = dice.uniform(0.12, 0.4);
  plan.grip_N_per_m = dice.log_uniform(700.0, 4000.0);
  plan.grip_N_s_per_m = 2.0 * dice.uniform(0.15, 0.5) * std::sqrt(plan.grip_N_per_m * plan.probe_mass_kg);
  plan.arm_N_per_m = dice.log_uniform(120.0, 500.0);
  plan.arm_N_s_per_m = 2.0 * dice.uniform(0.4, 1.0) * std::sqrt(plan.arm_N_per_m * plan.hand_mass_kg);
  plan.tremor_N = dice.log_uniform(0.02, 0.1);
  plan.tremor_Hz = dice.uniform(8.0, 11.5);
  plan.lateral_m = dice.uniform(0.02e-3, 0.1e-3);
  plan.turn_rad = dice.uniform(0.01, 0.035);
  plan.follow_normal = dice.uniform(0.5, 0.9);
}

void draw_probe(ScanPlan& plan, Dice& dice) {
  plan.tip_in_marker_m = {2e-3 * dice.normal(), dice.uniform(0.08, 0.12), dice.uniform(5e-3, 15e-3)};
  plan.sensor_in_marker_m = {3e-3 * dice.normal(), dice.uniform(0.02, 0.06), dice.uniform(5e-3, 15e-3)};
  const double faults = dice.chance(0.35) ? 0.0 : dice.uniform(0.3, 2.0);
  if (plan.open) {
    plan.rate_Hz = std::vector<double>{1000.0, 1600.0, 2000.0, 3200.0, 4000.0}[static_cast<std::size_t>(dice.below(5))];
    plan.nominal_rate_Hz = plan.rate_Hz;
    plan.filter_Hz = dice.uniform(0.25, 0.42) * plan.rate_Hz;
    plan.filter_q = dice.uniform(0.55, 0.85);
    plan.resonance_Hz = dice.uniform(2000.0, 6000.0);
    plan.resonance_q = dice.log_uniform(0.7, 4.0);
    plan.accel_noise_mps2_per_rtHz = dice.log_uniform(4e-4, 1.5e-3);
    plan.accel_flicker_mps2 = dice.log_uniform(5e-4, 5e-3);
    plan.accel_drift_mps2 = dice.log_uniform(2e-3, 2e-2);
    plan.gyro_noise_radps_per_rtHz = dice.log_uniform(4e-5, 1.2e-4);
    plan.force_rate_Hz = std::min(plan.rate_Hz, dice.log_uniform(80.0, 1000.0));
    plan.force_filter_Hz = dice.uniform(60.0, 200.0);
    if (dice.chance(0.4)) plan.batch_s = dice.uniform(4e-3, 12e-3);
    plan.stamp_jitter_s = dice.log_uniform(5e-6, 60e-6);
    plan.spike_chance = dice.chance(0.3) ? 3e-4 * faults : 0.0;
    plan.lost_chance = dice.chance(0.3) ? 1e-4 * faults : 0.0;
    plan.frame_rate_Hz = dice.uniform(60.0, 120.0);
  } else {
    plan.rate_Hz = 400.0;
    plan.nominal_rate_Hz = dice.chance(0.5) ? 500.0 : 400.0;
    plan.adc_min = 0.0;
    plan.adc_max = 255.0;
    plan.accel_counts_per_g = dice.uniform(45.0, 58.0);
    plan.accel_noise_mps2_per_rtHz = dice.log_uniform(1.5e-3, 4e-3);
    plan.accel_flicker_mps2 = dice.log_uniform(2e-3, 2e-2);
    plan.accel_drift_mps2 = dice.log_uniform(5e-3, 5e-2);
    plan.filter_Hz = 200.0;
    plan.resonance_Hz = dice.uniform(5000.0, 8000.0);
    plan.resonance_q = dice.uniform(2.0, 6.0);
    plan.sensor_in_marker_m = plan.tip_in_marker_m + Eigen::Vector3d(2e-3, -5e-3, 1e-3);
    plan.force_rate_Hz = 400.0;
    plan.force_filter_Hz = 150.0;
    plan.force_newton_per_count = 0.025;
    plan.force_noise_N = 0.01;
    plan.stamp_step_s = 1e-3;
    plan.spike_chance = 3e-3 * faults;
    plan.lost_chance = 2e-3 * faults;
    plan.frame_rate_Hz = dice.uniform(30.0, 60.0);
    plan.accel_scale_error = 0.008;
    plan.accel_offset_error_mps2 = 0.08;
    plan.force_scale_error = 0.02;
    plan.force_offset_error_N = 0.04;
  }
  plan.tip_mass_kg = dice.uniform(1e-3, 5e-3);
}

void draw_tracker(ScanPlan& plan, Dice& dice) {
  plan.latency_s = dice.uniform(6e-3, 30e-3);
  plan.frame_jitter_s = dice.log_uniform(0.05e-3, 0.5e-3);
  const double level = dice.log_uniform(0.6, 1.8);
  plan.noise_across_m *= level;
  plan.noise_along_m *= level * dice.uniform(0.7, 1.5);
  plan.noise_tilt_rad *= level;
  plan.noise_about_rad *= level;
  plan.slow_share = dice.uniform(0.0, 0.5);
  plan.slow_time_s = dice.log_uniform(0.3, 3.0);
  const double faults = dice.chance(0.3) ? 0.0 : dice.uniform(0.3, 2.0);
  plan.lost_frames *= faults;
  plan.outlying_frames *= faults;
  plan.flipped_frames *= faults;
  plan.states_frame_sigmas = dice.chance(0.5);
  plan.tip_error_m = dice.log_uniform(0.04e-3, 0.2e-3);
  plan.sensor_place_error_m = dice.log_uniform(0.2e-3, 1e-3);
  plan.latency_error_s = dice.log_uniform(0.5e-3, 4e-3);
}

}  // namespace

const std::vector<std::string>& families() {
  static const std::vector<std::string> kFamilies{"sine",  "sines", "field", "ridges", "holes",
                                                  "steps", "fine",  "glass", "air"};
  return kFamilies;
}

ScanPlan draw_plan(std::uint64_t seed, const std::string& family, const std::string& probe) {
  Dice dice(seed, 1);
  ScanPlan plan;
  plan.seed = seed;
  const int drawn = dice.below(static_cast<int>(families().size()));
  plan.family = family.empty() ? families()[static_cast<std::size_t>(drawn)] : family;
  if (std::find(families().begin(), families().end(), plan.family) == families().end())
    throw std::invalid_argument("no family '" + plan.family + "'");
  const bool open = dice.chance(0.55);
  plan.open = probe.empty() ? open : probe == "open";
  draw_object(plan, dice);
  draw_hand(plan, dice);
  draw_contact(plan, dice);
  draw_probe(plan, dice);
  draw_tracker(plan, dice);
  return plan;
}

}  // namespace second_bench
