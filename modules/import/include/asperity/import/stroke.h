#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "asperity/base/problem.h"

namespace asperity {

// A stroke of a haptic recording without orientations, as series of one length at even times.
struct Stroke {
  double rate_Hz = 0.0;
  double start_s = 0.0;                   // on the acceleration's clock
  std::vector<double> acceleration_mps2;  // one series of all axes, high-passed
  std::vector<double> x_m, y_m, z_m;      // of the tip; empty: not known
  std::vector<double> speed_mps;          // empty: not known
  std::vector<double> force_N;            // empty: not known
  double high_pass_Hz = 0.0;              // that the acceleration went through
  int axes = 0;                           // of the accelerometer
  bool speed_is_measured = false;         // else it is one that was stated
  bool force_is_measured = false;
  double contact_N = 0.05;  // from this force on the tip counts as touching
  double noise_mps2 = 0.0;  // of the sensor above 40 Hz, RMS, as stated; 0: not stated
  Problems problems;

  std::size_t size() const { return acceleration_mps2.size(); }
};

// A file that a stroke was read from.
struct StrokeOrigin {
  std::string file;
  std::uint64_t bytes = 0;
  std::uint32_t crc32 = 0;
  std::string columns;   // as --columns takes them
  double rate_Hz = 0.0;  // of rows without times; 0: they have times
};

}  // namespace asperity
