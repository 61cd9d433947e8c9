#include "asperity/trajectory/scan_speed.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "asperity/signal/statistics.h"

namespace asperity {

double average_scan_speed_mps(std::span<const Eigen::Vector3d> p_m, double period_s, double window_s) {
  if (p_m.size() < 2) return 0.0;
  const auto wanted = static_cast<std::size_t>(std::max(1.0, std::round(window_s / period_s)));
  const std::size_t step = std::min(wanted, p_m.size() - 1);
  std::vector<double> speed_mps;
  for (std::size_t i = 0; i + step < p_m.size(); i += step) {
    speed_mps.push_back((p_m[i + step] - p_m[i]).norm() / (static_cast<double>(step) * period_s));
  }
  return median(speed_mps);
}

}  // namespace asperity
