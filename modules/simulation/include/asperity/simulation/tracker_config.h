#pragma once

#include <array>

namespace asperity {

// The optical tracker. Noise values hold at `reference_distance_m` with the marker facing the camera.
struct SimulatedTrackerConfig {
  double rate_Hz = 120.0;
  double latency_s = 0.012;
  double clock_jitter_s = 0.1e-3;
  double clock_step_s = 0.0;                                 // resolution of time stamps; 0: 1 ns
  double reference_distance_m = 0.28;                        // thesis Fig. 9
  std::array<double, 3> noise_m{0.15e-3, 0.13e-3, 0.54e-3};  // right, down, along the ray (thesis Fig. 9)
  std::array<double, 3> noise_rad{4.4e-3, 4.4e-3, 1.5e-3};   // about the ray's right, down and itself
  double slow_share = 0.0;   // a drift of each axis, as a share of the frame's own noise
  double slow_time_s = 1.0;  // its correlation time
  double mount_Hz = 0.0;     // the marker's resonance on the probe; 0: rigid
  double mount_damping_ratio = 0.05;
  double mount_length_m = 0.03;  // over which the mount bends
  double clock_wander_s = 0.0;   // drift of the stamps, standard deviation
  double clock_wander_time_s = 2.0;
  double dropout_chance = 0.003;  // that a run of lost frames begins
  double dropout_frames = 3.0;    // its mean length
  double flip_chance = 0.002;     // that a run of flipped poses begins
  double flip_frames = 2.0;       // its mean length
  double flip_depth_m = 2e-3;     // rms shift along the ray while flipped

  template <class V>
  void visit(V& v) {
    v.field("rate_Hz", rate_Hz, "frames a second, Hz", {1.0, 2000.0});
    v.field("latency_s", latency_s, "from exposure to time stamp, s", {0.0, 1.0});
    v.field("clock_jitter_s", clock_jitter_s, "jitter of a time stamp, s rms", {0.0, 0.1});
    v.field("clock_step_s", clock_step_s, "resolution of time stamps, s; 0 for 1 ns", {0.0, 0.1});
    v.field("reference_distance_m", reference_distance_m, "distance for which the noise values are given, m",
            {0.01, 10.0});
    v.field("noise_m", noise_m, "position noise right, down and along the ray, m rms", {0.0, 0.1});
    v.field("noise_rad", noise_rad, "rotation noise about right, down and the ray, rad rms", {0.0, 0.5});
    v.field("slow_share", slow_share, "drift of each axis, as a share of the frame's noise", {0.0, 100.0});
    v.field("slow_time_s", slow_time_s, "its correlation time, s", {0.01, 1e4});
    v.field("mount_Hz", mount_Hz, "resonance of the marker on the probe, Hz; 0: rigid", {0.0, 1e4});
    v.field("mount_damping_ratio", mount_damping_ratio, "damping of that resonance, of critical", {0.0, 2.0});
    v.field("mount_length_m", mount_length_m, "length over which the mount bends, m", {1e-3, 1.0});
    v.field("clock_wander_s", clock_wander_s, "drift of the time stamps, s", {0.0, 0.1});
    v.field("clock_wander_time_s", clock_wander_time_s, "its correlation time, s", {0.01, 1e4});
    v.field("dropout_chance", dropout_chance, "chance that a run of lost frames begins", {0.0, 1.0});
    v.field("dropout_frames", dropout_frames, "its mean length, frames", {1.0, 1e4});
    v.field("flip_chance", flip_chance, "chance that a run of flipped poses begins", {0.0, 1.0});
    v.field("flip_frames", flip_frames, "its mean length, frames", {1.0, 1e4});
    v.field("flip_depth_m", flip_depth_m, "shift along the ray while flipped, m rms", {0.0, 0.1});
  }
};

}  // namespace asperity
