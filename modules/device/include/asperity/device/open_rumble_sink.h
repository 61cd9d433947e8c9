#pragma once

#include <memory>
#include <string>

#include "asperity/device/vibration_sink.h"

namespace asperity {

struct RumbleSinkConfig {
  std::string device;             // part of the gamepad's name; empty: the first that rumbles
  double servo_rate_Hz = 1000.0;  // at which forces are pushed
  double update_rate_Hz = 100.0;  // of the motors
  double high_pass_Hz = 20.0;     // below, nothing vibrates
  double split_Hz = 100.0;        // below: the heavy, slow motor; above: the light, fast one
  double full_scale_N = 1.0;      // amplitude that is full strength at volume 1
  double volume = 0.5;
  double ceiling = 0.8;         // largest strength
  double stale_after_s = 0.05;  // without a force the motors stop
  template <class V>
  void visit(V& v) {
    v.field("device", device, "part of the gamepad's name; empty: the first that rumbles");
    v.field("servo_rate_Hz", servo_rate_Hz, "rate of the pushed forces, Hz", {100.0, 4000.0});
    v.field("update_rate_Hz", update_rate_Hz, "rate of the motors' strengths, Hz", {5.0, 100.0});
    v.field("high_pass_Hz", high_pass_Hz, "-3 dB point below both motors, Hz", {1.0, 40.0});
    v.field("split_Hz", split_Hz, "-3 dB point between the motors, Hz", {1.0, 1000.0});
    v.field("full_scale_N", full_scale_N, "amplitude of full strength at volume 1, N", {0.001, 1000.0});
    v.field("volume", volume, "factor", {0.0, 1.0});
    v.field("ceiling", ceiling, "largest strength", {0.01, 1.0});
    v.field("stale_after_s", stale_after_s, "without a force: the motors stop, s", {0.01, 1.0});
  }
};

// A gamepad's two motors by SDL 2. push() puts the force in a ring; a thread of the sink's own takes it out at
// `update_rate_Hz`, splits it in two bands and gives each motor √2 times its band's RMS value since the last update:
// the amplitude, for a sine. Each command lasts 0.2 s unless renewed.
// Throws Error: config out of range, no gamepad that rumbles and fits `device`.
std::unique_ptr<VibrationSink> open_rumble_sink(const RumbleSinkConfig& config);

}  // namespace asperity
