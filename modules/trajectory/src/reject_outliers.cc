#include "asperity/trajectory/reject_outliers.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "asperity/signal/statistics.h"

namespace asperity {
namespace {

using Sample = std::array<double, 4>;  // three axes in m/s², the force in N

Sample sample_at(const ProbeStream& probe, std::size_t i, const Sample& per_count) {
  return {probe.accel_counts[i].x() * per_count[0], probe.accel_counts[i].y() * per_count[1],
          probe.accel_counts[i].z() * per_count[2], probe.force_counts[i] * per_count[3]};
}

// The level at the start, that a spike in the very first sample cannot set.
Sample first_level(const ProbeStream& probe, const Sample& per_count) {
  constexpr std::size_t kSamples = 11;
  Sample level;
  for (std::size_t k = 0; k < level.size(); ++k) {
    std::vector<double> values;
    for (std::size_t i = 0; i < probe.size() && values.size() < kSamples; ++i) {
      const double value = sample_at(probe, i, per_count)[k];
      if (!std::isnan(value)) values.push_back(value);
    }
    level[k] = values.empty() ? std::nan("") : median(values);
  }
  return level;
}

}  // namespace

Outliers reject_outliers(const ProbeStream& probe, const Calibration& calibration, const OutlierConfig& config) {
  Outliers out;
  out.rejected.assign(probe.size(), false);
  if (probe.size() == 0) return out;

  const Eigen::Vector3d counts_per_mps2 = calibration.accelerometer.B.leftCols<3>().rowwise().norm();
  const Sample per_count = {1.0 / counts_per_mps2.x(), 1.0 / counts_per_mps2.y(), 1.0 / counts_per_mps2.z(),
                            std::abs(calibration.force.newton_per_count)};
  const Sample limit = {config.accel_step_mps2, config.accel_step_mps2, config.accel_step_mps2, config.force_step_N};

  Sample kept = first_level(probe, per_count);
  std::size_t run = 0;
  for (std::size_t i = 0; i < probe.size(); ++i) {
    const Sample now = sample_at(probe, i, per_count);
    bool steps = false;
    for (std::size_t k = 0; k < now.size(); ++k) steps = steps || std::abs(now[k] - kept[k]) > limit[k];
    if (steps && run < static_cast<std::size_t>(config.longest_run)) {
      out.rejected[i] = true;
      ++run;
      continue;
    }
    if (steps) std::fill_n(out.rejected.begin() + static_cast<std::ptrdiff_t>(i - run), run, false);
    run = 0;
    for (std::size_t k = 0; k < now.size(); ++k) {
      if (!std::isnan(now[k])) kept[k] = now[k];
    }
  }
  out.count = static_cast<std::size_t>(std::count(out.rejected.begin(), out.rejected.end(), true));
  return out;
}

}  // namespace asperity
