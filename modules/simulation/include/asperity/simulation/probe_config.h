#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace asperity {

enum class ProbeModel { kWhat, kOpen };
inline constexpr std::array<std::string_view, 2> kProbeModelNames = {"what", "open"};

// The probe's sensors and its link. Sources of the values: docs/virtual-bench.md.
struct SimulatedProbeConfig {
  ProbeModel model = ProbeModel::kOpen;
  std::array<double, 3> tip_in_marker_m{0.0, 0.10, 0.010};
  std::array<double, 3> sensor_in_marker_m{0.0, 0.03, 0.012};

  double nominal_rate_Hz = 4000.0;
  double true_rate_Hz = 4000.0;
  double adc_min = -32768.0;
  double adc_max = 32767.0;
  bool quantise = true;  // round and clip to the converter's range

  double accel_noise_mps2_per_rtHz = 6.9e-4;  // 70 µg/√Hz
  double accel_bandwidth_Hz = 1000.0;         // 0: none
  int accel_poles = 2;                        // of the low-pass: 1 (RC) or 2 (Butterworth)
  bool gyroscope = true;
  double gyro_noise_radps_per_rtHz = 4.9e-5;  // 2.8 mdps/√Hz
  double gyro_bandwidth_Hz = 1000.0;
  double force_rate_Hz = 320.0;  // at most the probe's
  double force_noise_N = 0.005;
  double force_bandwidth_Hz = 100.0;

  bool force3 = false;            // a force sensor of three axes in addition to the axial one
  double force3_noise_N = 0.005;  // each axis

  // What changes slowly; see docs/virtual-bench.md.
  double accel_flicker_mps2 = 0.0;  // RMS of 1/f noise, each axis
  double gyro_flicker_radps = 0.0;
  double accel_warming_mps2 = 0.0;  // how far the offset goes while the chip warms, standard deviation each axis
  double warming_s = 10.0;

  double clock_drift_ppm = 0.0;  // the crystal's error: samples are taken so much faster
  double clock_wander_s = 0.0;   // drift of the stamps, standard deviation
  double clock_wander_time_s = 2.0;
  int batch_samples = 1;          // that arrive at the host together
  double batch_delay_s = 0.2e-3;  // mean of the exponential wait of a batch; the mean itself is part of the latency
  double clock_jitter_s = 20e-6;  // rms, of a time stamp
  double clock_step_s = 0.0;      // resolution of time stamps; 0: 1 ns
  double delivery_delay_s = 0.0;  // mean of an exponential delay
  double dropout_chance = 0.0;    // that a burst of lost samples begins at a sample
  double dropout_samples = 10.0;  // mean length of a burst
  double spike_chance = 0.0;      // that a sample's fields are all replaced by random ones

  template <class V>
  void visit(V& v) {
    v.choice("model", model, kProbeModelNames, "whose axes and converters are simulated");
    v.field("tip_in_marker_m", tip_in_marker_m, "contact point in the marker frame, m", {-1.0, 1.0});
    v.field("sensor_in_marker_m", sensor_in_marker_m, "accelerometer and gyroscope in the marker frame, m",
            {-1.0, 1.0});
    v.field("nominal_rate_Hz", nominal_rate_Hz, "rate that the probe claims, Hz", {1.0, 1e5});
    v.field("true_rate_Hz", true_rate_Hz, "rate that it has, Hz; at most one sample a step", {1.0, 1e5});
    v.field("adc_min", adc_min, "lowest count", {-1e9, 1e9});
    v.field("adc_max", adc_max, "highest count", {-1e9, 1e9});
    v.field("quantise", quantise, "round to counts and clip to the range");
    v.field("accel_noise_mps2_per_rtHz", accel_noise_mps2_per_rtHz, "noise density of the accelerometer, m/s²/√Hz",
            {0.0, 10.0});
    v.field("accel_bandwidth_Hz", accel_bandwidth_Hz, "its -3 dB bandwidth, Hz; 0 for none", {0.0, 1e5});
    v.field("accel_poles", accel_poles, "poles of the low-pass of accelerometer and gyroscope: 1 RC, 2 Butterworth",
            {1, 2});
    v.field("gyroscope", gyroscope, "has one");
    v.field("gyro_noise_radps_per_rtHz", gyro_noise_radps_per_rtHz, "noise density of the gyroscope, rad/s/√Hz",
            {0.0, 10.0});
    v.field("gyro_bandwidth_Hz", gyro_bandwidth_Hz, "its -3 dB bandwidth, Hz; 0 for none", {0.0, 1e5});
    v.field("force_rate_Hz", force_rate_Hz, "rate of the force sensor, Hz", {1.0, 1e5});
    v.field("force_noise_N", force_noise_N, "noise of a force sample, N rms", {0.0, 10.0});
    v.field("force_bandwidth_Hz", force_bandwidth_Hz, "-3 dB bandwidth of the force sensor, one pole, Hz; 0 for none",
            {0.0, 1e5});
    v.field("force3", force3, "has a force sensor of three axes too");
    v.field("force3_noise_N", force3_noise_N, "noise of its samples, N rms each axis", {0.0, 10.0});
    v.field("accel_flicker_mps2", accel_flicker_mps2, "1/f noise of the accelerometer, 0.03 to 30 Hz, m/s² rms",
            {0.0, 10.0});
    v.field("gyro_flicker_radps", gyro_flicker_radps, "1/f noise of the gyroscope, rad/s rms", {0.0, 10.0});
    v.field("accel_warming_mps2", accel_warming_mps2, "drift of the accelerometer's offset as it warms, m/s²",
            {0.0, 10.0});
    v.field("warming_s", warming_s, "time constant of the warming, s", {0.1, 1e5});
    v.field("clock_drift_ppm", clock_drift_ppm, "error of the probe's crystal, ppm", {-1e4, 1e4});
    v.field("clock_wander_s", clock_wander_s, "drift of the time stamps, s", {0.0, 0.1});
    v.field("clock_wander_time_s", clock_wander_time_s, "its correlation time, s", {0.01, 1e4});
    v.field("batch_samples", batch_samples, "samples that arrive together; 1: each by itself", {1, 10000});
    v.field("batch_delay_s", batch_delay_s, "mean wait of a batch, s", {0.0, 0.1});
    v.field("clock_jitter_s", clock_jitter_s, "jitter of a time stamp, s rms", {0.0, 0.1});
    v.field("clock_step_s", clock_step_s, "resolution of time stamps, s; 0 for 1 ns", {0.0, 0.1});
    v.field("delivery_delay_s", delivery_delay_s, "mean of the exponential delay of a time stamp, s", {0.0, 0.1});
    v.field("dropout_chance", dropout_chance, "chance that a burst of lost samples begins", {0.0, 1.0});
    v.field("dropout_samples", dropout_samples, "mean length of such a burst, samples", {1.0, 1e4});
    v.field("spike_chance", spike_chance, "chance that all fields of a sample are corrupted", {0.0, 1.0});
  }
};

// How far the calibration that goes with the recording is from the truth (standard deviations).
struct SimulatedCalibrationConfig {
  double imperfection = 1.0;      // factor on all below; 0 gives the exact calibration
  double accel_scale = 1.5e-3;    // relative, each element of B against the row's largest
  double accel_bias_mps2 = 0.03;  // 3 mg
  double gyro_scale = 2e-3;
  double gyro_bias_radps = 1e-3;  // 0.06 dps
  double force_scale = 0.01;
  double force_offset_N = 0.01;
  double tip_m = 0.1e-3;
  double sensor_m = 0.2e-3;
  double gravity_direction_rad = 1e-3;
  double tracker_sigma = 0.1;  // relative error of the stated noise
  double latency_s = 2e-3;

  template <class V>
  void visit(V& v) {
    v.field("imperfection", imperfection, "factor on all errors of the calibration; 0 makes it exact", {0.0, 100.0});
    v.field("accel_scale", accel_scale, "relative error of the accelerometer's B", {0.0, 0.5});
    v.field("accel_bias_mps2", accel_bias_mps2, "error of the accelerometer's offset, m/s²", {0.0, 10.0});
    v.field("gyro_scale", gyro_scale, "relative error of the gyroscope's B", {0.0, 0.5});
    v.field("gyro_bias_radps", gyro_bias_radps, "error of the gyroscope's offset, rad/s", {0.0, 10.0});
    v.field("force_scale", force_scale, "relative error of newtons per count", {0.0, 0.5});
    v.field("force_offset_N", force_offset_N, "error of the force's offset, N", {0.0, 10.0});
    v.field("tip_m", tip_m, "error of the tip in the marker frame, m per axis", {0.0, 0.1});
    v.field("sensor_m", sensor_m, "error of the sensor in the marker frame, m per axis", {0.0, 0.1});
    v.field("gravity_direction_rad", gravity_direction_rad, "error of the stated direction of gravity, rad per axis",
            {0.0, 0.5});
    v.field("tracker_sigma", tracker_sigma, "relative error of the tracker's stated noise", {0.0, 0.5});
    v.field("latency_s", latency_s, "error of the tracker's stated latency, s", {0.0, 0.5});
  }
};

}  // namespace asperity
