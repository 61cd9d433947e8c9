#pragma once

#include <span>

#include "asperity/calibration/tracker_noise.h"

namespace asperity {

// One measured standard deviation.
struct NoiseAtPose {
  double distance_m = 0.0;
  double tilt_rad = 0.0;
  double sigma = 0.0;
  double sigma_error = 0.0;
};

// ln σ = ln scale + power ln d − tilt_power ln cos(tilt) by weighted least squares, the weights from the
// standard errors of σ, which are believed (the errors of the result do not come from its residuals). `power` is held,
// and in a second fit free. The tilt's term is fitted where the poses' largest cosine is `least_tilt_ratio` times the
// smallest. Throws Error for fewer than three poses, or figures that are not positive and finite.
NoiseLaw fit_noise_law(std::span<const NoiseAtPose> poses, double power, double least_tilt_ratio);

}  // namespace asperity
