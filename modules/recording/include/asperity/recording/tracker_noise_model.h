#pragma once

#include "asperity/json/json.h"

namespace asperity {

// σ = scale · (distance / 1 m)^power · cos(tilt)^−tilt_power, for the white part.
struct NoiseLaw {
  double scale = 0.0;  // m or rad, at 1 m and facing the camera
  double scale_error = 0.0;
  double power = 0.0;       // of the distance, as geometry demands
  double tilt_power = 0.0;  // 0 where the static intervals were too similar
  double tilt_power_error = 0.0;
  double measured_power = 0.0;  // the power that the data themselves have, for comparison
  double measured_power_error = 0.0;
  double chi_square = 0.0;  // of the fit with the power held
  int degrees_of_freedom = 0;
};

// A tracker's noise over distance and tilt (extra.tracker_noise_model of a calibration.json).
struct TrackerNoiseModel {
  NoiseLaw across_m, along_m;    // the ray; powers 1 and 2
  NoiseLaw about_rad, tilt_rad;  // about the ray, and about axes across it; powers 1 and 2
  double nearest_m = 0.0, farthest_m = 0.0, steepest_rad = 0.0;  // where it was measured
};

// As files and reports have it.
Json noise_model_json(const TrackerNoiseModel& model);

}  // namespace asperity
