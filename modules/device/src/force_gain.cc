#include "asperity/device/force_gain.h"

#include <algorithm>

namespace asperity {

double next_gain(double gain, bool well, const SafetyConfig& config, double dt_s) noexcept {
  if (well) return config.soft_start_s > 0.0 ? std::min(gain + dt_s / config.soft_start_s, 1.0) : 1.0;
  return config.ramp_down_s > 0.0 ? std::max(gain - dt_s / config.ramp_down_s, 0.0) : 0.0;
}

}  // namespace asperity
