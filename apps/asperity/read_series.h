#pragma once

#include <string>
#include <vector>

namespace asperity::app {

// A tool's acceleration over a texture with the speed and force it had, sampled evenly.
struct SeriesTable {
  std::vector<double> acceleration_mps2;
  std::vector<double> speed_mps;
  std::vector<double> force_N;
  double rate_Hz = 0.0;
};

// A table t_s,acceleration_mps2,speed_mps,force_N (more columns allowed). Throws Error naming file, line and
// column for a number that is missing or not finite, or times that are not even to a hundredth of a step.
SeriesTable read_series(const std::string& file);

}  // namespace asperity::app
