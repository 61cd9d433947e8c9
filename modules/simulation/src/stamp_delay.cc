#include "asperity/simulation/stamp_delay.h"

#include <algorithm>
#include <cstddef>
#include <vector>

#include "asperity/base/error.h"
#include "asperity/simulation/low_pass.h"

namespace asperity {

double stamp_delay_s(const ProbeStream& recorded, const Recording& bench) {
  constexpr std::size_t kLook = 4000;  // rows that a loss may have taken at once
  std::vector<double> late_s;
  std::size_t place = 0;
  const std::size_t size = bench.probe.size();
  for (std::size_t i = 0; i < recorded.size(); ++i) {
    const auto alike = [&](std::size_t k) {
      return bench.probe.accel_counts[k] == recorded.accel_counts[i] &&
             (!recorded.has_gyro() || bench.probe.gyro_counts[k] == recorded.gyro_counts[i]);
    };
    std::size_t k = place;
    while (k < std::min(size, place + kLook) && !alike(k)) ++k;
    if (k >= std::min(size, place + kLook)) continue;
    late_s.push_back(1e-9 * static_cast<double>(recorded.t_ns[i] - bench.truth->t_ns[k]));
    place = k + 1;
  }
  if (late_s.empty() || 2 * late_s.size() < recorded.size())
    throw Error("the recorded rows are not those of the bench");
  const auto middle = late_s.begin() + static_cast<std::ptrdiff_t>(late_s.size() / 2);
  std::nth_element(late_s.begin(), middle, late_s.end());
  return *middle;
}

double gyroscope_delay_s(const SimulationConfig& config) {
  return SensorLowPass<double>(config.probe.gyro_bandwidth_Hz, config.probe.accel_poles, 1.0 / config.step_s).delay_s();
}

}  // namespace asperity
