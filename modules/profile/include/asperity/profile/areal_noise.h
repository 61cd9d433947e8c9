#pragma once

#include <vector>

namespace asperity {

// What is known of the errors of a map's heights.
struct ArealNoise {
  double rms_m = 0.0;           // standard deviation of a height; 0: not known
  std::vector<double> sigma_m;  // the same of each height; empty: rms_m everywhere
  double correlation_m = 0.0;   // distance at which the errors' correlation is 0.2; 0: each point has its own
  double rms_sigma = 0.0;       // relative standard error of rms_m

  bool is_known() const { return rms_m > 0.0; }
};

}  // namespace asperity
