#pragma once

#include <string>

namespace asperity {

// A probe's description of itself, or that of its kind. Names are as received: escape them where
// they are printed. Zero: unknown.
struct ProbeDescription {
  std::string model;     // "what", "open"
  std::string name;      // of this very probe
  std::string firmware;  // its version
  double rate_Hz = 0.0;  // of the inertial sensor
  double adc_min = 0.0;
  double adc_max = 0.0;
  double accel_counts_per_mps2 = 0.0;  // nominal
  bool has_gyro = false;
  double gyro_counts_per_radps = 0.0;  // nominal
  int force_axes = 1;                  // 1 or 3
  double force_rate_Hz = 0.0;
  double force_newton_per_count = 0.0;  // nominal
};

}  // namespace asperity
