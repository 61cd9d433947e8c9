#include <algorithm>
#include <cmath>
#include <vector>

#include "asperity/pipeline/force_limit.h"
#include "asperity/signal/statistics.h"

namespace asperity {

namespace {

constexpr double kFewestReadings = 8.0;
constexpr double kTimesMore = 8.0;  // than at the value next to it

// How many equal readings there usually are in a row: those that are held between two conversions.
double usual_run(const std::vector<double>& counts, double extreme) {
  std::vector<double> lengths;
  for (std::size_t i = 0; i < counts.size();) {
    std::size_t end = i + 1;
    while (end < counts.size() && counts[end] == counts[i]) ++end;
    if (counts[i] != extreme) lengths.push_back(static_cast<double>(end - i));
    i = end;
  }
  return lengths.empty() ? 1.0 : median(lengths);
}

// How many readings are at `extreme`, if that is a plateau.
std::size_t in_plateau(const std::vector<double>& counts, double extreme, double no_load) {
  // The value next to it, on the side of no load.
  double next = no_load;
  for (const double x : counts) {
    if (x != extreme && std::abs(x - extreme) < std::abs(next - extreme)) next = x;
  }
  const auto readings = [&](double value) {
    return static_cast<double>(std::count(counts.begin(), counts.end(), value));
  };
  const double found = readings(extreme);
  if (found < kFewestReadings * usual_run(counts, extreme) || found < kTimesMore * readings(next)) return 0;
  return static_cast<std::size_t>(found);
}

// `no_load`: counts without a force.
void add_channel(const std::vector<double>& counts, const RecordingInfo& info, double no_load, double newton_per_count,
                 ForceLimit& out) {
  if (counts.empty()) return;
  const auto [low, high] = std::minmax_element(counts.begin(), counts.end());
  if (*low == *high) return;
  const double extreme = std::abs(*high - no_load) >= std::abs(*low - no_load) ? *high : *low;
  std::size_t found = 0;
  if (info.adc_max > info.adc_min) {
    found = static_cast<std::size_t>(
        std::count_if(counts.begin(), counts.end(), [&](double x) { return x <= info.adc_min || x >= info.adc_max; }));
  }
  found = std::max(found, in_plateau(counts, extreme, no_load));
  if (found == 0) return;
  out.at_limit = std::max(out.at_limit, found);
  out.limit_N = std::max(out.limit_N, std::abs(newton_per_count * (extreme - no_load)));
}

}  // namespace

ForceLimit find_force_limit(const Recording& recording) {
  ForceLimit out;
  const auto finite = [&](const auto& rows, auto value_of) {
    std::vector<double> counts;
    for (const auto& row : rows) {
      if (std::isfinite(value_of(row))) counts.push_back(value_of(row));
    }
    out.readings = std::max(out.readings, counts.size());
    return counts;
  };
  const ForceCalibration& axial = recording.calibration.force;
  if (axial.newton_per_count != 0.0) {
    add_channel(finite(recording.probe.force_counts, [](double x) { return x; }), recording.info,
                -axial.offset_newton / axial.newton_per_count, axial.newton_per_count, out);
  }
  if (!recording.calibration.force3) return out;
  const Force3Calibration& three = *recording.calibration.force3;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    const double count_per_newton = three.B.row(axis).norm();
    add_channel(finite(recording.probe.force3_counts, [axis](const Eigen::Vector3d& x) { return x[axis]; }),
                recording.info, three.C[axis], count_per_newton > 0.0 ? 1.0 / count_per_newton : 0.0, out);
  }
  return out;
}

}  // namespace asperity
