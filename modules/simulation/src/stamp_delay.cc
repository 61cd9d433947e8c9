#include "asperity/simulation/stamp_delay.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "asperity/base/error.h"
#include "asperity/simulation/low_pass.h"

namespace asperity {

double stamp_delay_s(const ProbeStream& recorded, const Recording& bench, double skip_s) {
  constexpr std::size_t kLook = 4000;  // rows that a loss may have taken at once
  const std::int64_t from_ns = bench.truth->t_ns.front() + std::llround(1e9 * skip_s);
  double sum_s = 0.0;
  std::size_t counted = 0, found = 0;
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
    ++found;
    if (bench.truth->t_ns[k] >= from_ns) {
      sum_s += 1e-9 * static_cast<double>(recorded.t_ns[i] - bench.truth->t_ns[k]);
      ++counted;
    }
    place = k + 1;
  }
  if (counted == 0 || 2 * found < recorded.size()) throw Error("the recorded rows are not those of the bench");
  return sum_s / static_cast<double>(counted);
}

double accelerometer_delay_s(const SimulationConfig& config) {
  return SensorLowPass<double>(config.probe.accel_bandwidth_Hz, config.probe.accel_poles, 1.0 / config.step_s)
      .delay_s();
}

}  // namespace asperity
