#pragma once

#include <vector>

#include "asperity/pipeline/process_result.h"

namespace asperity {

// What a probe's tip felt over time, evenly sampled: its acceleration along the surface's normal, with the speed
// along the surface and the normal force that it had.
struct RecordedSeries {
  std::vector<double> acceleration_mps2;
  std::vector<double> speed_mps;
  std::vector<double> force_N;
  double rate_Hz = 0.0;
};

// The series of a processed recording at its own mean rate, for textures that are time series. Out of contact and
// where the force was not measured, speed and force are 0. Throws Error for a motion without accelerations or a
// recording without force.
RecordedSeries recorded_series(const ProcessResult& result);

}  // namespace asperity
