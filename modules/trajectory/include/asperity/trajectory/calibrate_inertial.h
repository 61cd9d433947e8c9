#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "asperity/base/problem.h"
#include "asperity/recording/recording.h"
#include "asperity/trajectory/smooth_clock.h"

namespace asperity {

struct InertialConfig {
  double spike_sigmas = 8.0;   // a sample this far from its neighbours, which agree, in two channels is a spike
  double fast_reach_s = 0.01;  // over which the fast part of the specific force is averaged: a contact's ringing lasts
  double scale_error = 0.01;   // noise that grows with the motion: share of the moving specific force, each sample
  double rate_error = 0.003;   // likewise of the angular rate
  double sample_time_sigma_s = 2e-6;    // jitter that smoothing the clock leaves in a sample's time
  double saturation_sigma = 0.5;        // standard deviation of a clipped sample, share of the restored or hidden peak
  double gap_sigma_mps2 = 3.0;          // standard deviation of the specific force across a gap
  double accel_noise_floor_mps2 = 0.0;  // per sample; 0: from quantisation and the quietest stretch
  double gyro_noise_floor_radps = 0.0;  // per sample; likewise
  SmoothClockConfig clock;

  template <class V>
  void visit(V& v) {
    v.field("spike_sigmas", spike_sigmas,
            "a sample this far from its neighbours, which agree, in two channels is a spike", {3, 1000});
    v.field("fast_reach_s", fast_reach_s,
            "time to either side over which the specific force's fast part is averaged, s", {0, 1});
    v.field("scale_error", scale_error, "noise of a sample as a share of the moving specific force; learnt from here",
            {0, 1});
    v.field("rate_error", rate_error, "noise of a sample as a share of the angular rate; learnt from here", {0, 1});
    v.field("sample_time_sigma_s", sample_time_sigma_s, "jitter of a sample's smoothed time, s; learnt from here",
            {0, 1});
    v.field("saturation_sigma", saturation_sigma,
            "standard deviation of a clipped sample, share of the restored or hidden peak", {0, 100});
    v.field("gap_sigma_mps2", gap_sigma_mps2, "standard deviation of the specific force across a gap, m/s2", {0, 1e4});
    v.field("accel_noise_floor_mps2", accel_noise_floor_mps2, "accelerometer noise a sample, m/s2; 0: from the data",
            {0, 1e3});
    v.field("gyro_noise_floor_radps", gyro_noise_floor_radps, "gyroscope noise a sample, rad/s; 0: from the data",
            {0, 1e3});
    v.group("clock", clock);
  }
};

// The probe's stream in SI units with the trust that each sample deserves.
struct InertialStream {
  std::vector<std::int64_t> t_ns;                    // the clock's jitter removed, rising strictly
  std::vector<Eigen::Vector3d> specific_force_mps2;  // in the marker frame, or the sensor's if its rotation is unknown
  std::vector<Eigen::Vector3d> angular_rate_radps;   // zero without a gyroscope
  std::vector<double> accel_sigma_mps2;              // standard deviation of one sample
  std::vector<double> gyro_sigma_radps;              // likewise; zero without a gyroscope
  std::vector<double> accel_moving_mps2;             // size of the specific force less its mean of late
  // Mean products xx, yy, zz, xy, xz, yz of what in the specific force is as fast as the sampling, (m/s²)², over
  // `fast_reach_s` to either side: of the size of white noise that would leave as much.
  std::vector<Eigen::Matrix<float, 6, 1>> accel_fast_m2ps4;
  std::vector<double> force_N;                   // at every sample, interpolated; nan where there is none
  std::vector<Eigen::Vector3d> force3_marker_N;  // likewise, of a sensor with three axes; empty: there is none
  bool has_gyro = false;
  double period_s = 0.0;
  double clock_jitter_s = 0.0;
  double accel_noise_mps2 = 0.0;  // the floor in use
  double gyro_noise_radps = 0.0;
  std::size_t spikes = 0;
  std::size_t saturated = 0;
  // What restored peaks add to the noise of the acceleration along the marker's axes, one-sided density, m² s⁻³: a run
  // of n samples whose heights err by σ together changes the velocity by σ n T, and Σ 2 (σ n T)² over the duration is
  // white below the runs' rate.
  Eigen::Vector3d clipped_m2ps3 = Eigen::Vector3d::Zero();
  Problems problems;

  std::size_t size() const { return t_ns.size(); }
};

// Calibrates the probe's counts (erratum 4) and judges every sample: spikes (thesis §4.1) are replaced by
// their neighbours' mean, clipped peaks are restored by a cubic, and both get a standard deviation that
// takes their weight. Throws Error if there are fewer than two samples or the calibration is singular.
InertialStream calibrate_inertial(const Recording& recording, const InertialConfig& config);

}  // namespace asperity
