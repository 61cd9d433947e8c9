#include <algorithm>
#include <cmath>
#include <vector>

#include "asperity/pipeline/force_limit.h"
#include "asperity/signal/statistics.h"

namespace asperity {

namespace {

constexpr double kFewestReadings = 8.0;
constexpr double kTimesMore = 8.0;     // than at the value next to it
constexpr double kLoaded_share = 0.1;  // of the farthest reading from no load: nearer is no load

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

std::size_t readings_at(const std::vector<double>& counts, double value) {
  return static_cast<std::size_t>(std::count(counts.begin(), counts.end(), value));
}

// The value next to `value` towards no load; no_load where there is none.
double next_inwards(const std::vector<double>& counts, double value, double no_load) {
  double next = no_load;
  for (const double x : counts) {
    const bool inwards = value > no_load ? x < value : x > value;
    if (inwards && std::abs(x - value) < std::abs(next - value)) next = x;
  }
  return next;
}

// Readings at one end of the range.
struct End {
  std::size_t readings = 0;
  double counts = 0.0;
};

// `outermost`: the largest or the smallest reading. `at_converter`: it is the end of the converter's range.
End find_end(const std::vector<double>& counts, double outermost, double no_load, bool at_converter) {
  End out{0, outermost};
  if (at_converter) {
    out.readings = readings_at(counts, outermost);
    return out;
  }
  // Spikes may lie beyond the plateau.
  constexpr int kMostSpikes = 4;
  for (int k = 0; k < kMostSpikes && readings_at(counts, out.counts) < ForceLimit::kFewest; ++k)
    out.counts = next_inwards(counts, out.counts, no_load);
  const std::size_t found = readings_at(counts, out.counts);
  const auto readings = static_cast<double>(found);
  const double beside = static_cast<double>(readings_at(counts, next_inwards(counts, out.counts, no_load)));
  if (readings >= kFewestReadings * usual_run(counts, out.counts) && readings >= kTimesMore * beside)
    out.readings = found;
  return out;
}

// `no_load`: counts without a force. The range in the recording is that of the inertial sensors' converter: another one
// reads the force where a reading lies beyond it.
void add_channel(const std::vector<double>& counts, const RecordingInfo& info, double no_load, double newton_per_count,
                 ForceLimit& out) {
  if (counts.empty()) return;
  const auto [low, high] = std::minmax_element(counts.begin(), counts.end());
  const double reach = std::max(std::abs(*high - no_load), std::abs(*low - no_load));
  if (*low == *high || !(reach > 0.0)) return;
  const bool same_converter = info.adc_max > info.adc_min && *low >= info.adc_min && *high <= info.adc_max;
  std::size_t found = 0;
  double limit_counts = 0.0;
  for (const double end : {*low, *high}) {
    // Lifted off, a sensor reads no load, and may do so all the time.
    if (std::abs(end - no_load) < kLoaded_share * reach) continue;
    const bool at_converter = same_converter && (end == info.adc_min || end == info.adc_max);
    const End here = find_end(counts, end, no_load, at_converter);
    if (std::abs(here.counts - no_load) < kLoaded_share * reach) continue;
    found += here.readings;
    if (here.readings > 0) limit_counts = std::max(limit_counts, std::abs(here.counts - no_load));
  }
  if (found == 0) return;
  out.at_limit = std::max(out.at_limit, found);
  out.limit_N = std::max(out.limit_N, std::abs(newton_per_count) * limit_counts);
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
