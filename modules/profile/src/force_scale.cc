#include "asperity/profile/force_scale.h"

#include <algorithm>
#include <cmath>

#include "asperity/signal/moving_average.h"
#include "asperity/signal/resample.h"
#include "asperity/signal/statistics.h"

namespace asperity {

std::vector<double> force_scale(std::span<const double> force_N, std::size_t half_width) {
  std::vector<double> scale(force_N.size(), 1.0);
  const std::vector<double> bridged_N = bridge_gaps(force_N);
  if (bridged_N.empty() || std::isnan(bridged_N.front())) return scale;
  const auto [least, most] = std::minmax_element(bridged_N.begin(), bridged_N.end());
  if (*least == *most) return scale;  // before the average's rounding makes a range of it
  const std::vector<double> smooth_N = moving_average(bridged_N, half_width);
  const auto [low, high] = std::minmax_element(smooth_N.begin(), smooth_N.end());
  const double range_N = *high - *low;
  if (!(range_N > 0.0)) return scale;
  const double mean_N = mean(smooth_N);
  for (std::size_t i = 0; i < scale.size(); ++i) scale[i] = 1.0 - (smooth_N[i] - mean_N) / range_N;
  return scale;
}

}  // namespace asperity
