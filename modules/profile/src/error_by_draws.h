#pragma once

#include "asperity/base/nan.h"
#include "follow_noise.h"

namespace asperity {

// A parameter with the noise added to its heights once and twice, over draws; of one that follows the noise's power,
// its square with its sign.
struct FollowedValue {
  Spread once, twice;
};

// How a parameter follows noise.
struct NoiseResponse {
  bool follows_power = false;      // by its square: heights, slopes and curvatures
  bool hangs_on_extremes = false;  // on single heights, or high powers of them
};

// The standard error of `value`: the spread of the draws and what noise has changed it by, extrapolated from once and
// twice. Relative standard errors: of the noise's power, of all heights (`scale`), and of the value itself (`own`). nan
// where the value is.
double error_by_draws(double value, const FollowedValue& followed, const NoiseResponse& response, double power_sigma,
                      double scale_sigma, double own_sigma);

}  // namespace asperity
