#pragma once

namespace asperity {

// A vibration of one frequency in a profile's heights, by find_time_lines.h: hum of the mains, a motor, a fan.
struct TimeLine {
  double frequency_Hz = 0.0;
  double resolution_Hz = 0.0;  // two lines nearer to one another are one
  double rms_m = 0.0;          // of the heights, in their band
  // A pattern of the surface would look the same: the speed is too even, places are too uncertain, or the path bends.
  bool could_be_surface = false;
};

}  // namespace asperity
