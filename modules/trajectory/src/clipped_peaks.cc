#include "clipped_peaks.h"

#include <algorithm>
#include <cmath>

#include "asperity/base/nan.h"

namespace asperity {

std::vector<ClippedRun> find_clipped(const std::vector<Eigen::Vector3d>& x, const RecordingInfo& info) {
  std::vector<ClippedRun> runs;
  if (!(info.adc_max > info.adc_min)) return runs;
  for (int axis = 0; axis < 3; ++axis) {
    for (std::size_t i = 0; i < x.size(); ++i) {
      if (!(x[i][axis] <= info.adc_min) && !(x[i][axis] >= info.adc_max)) continue;
      const bool upper = x[i][axis] >= info.adc_max;
      ClippedRun run{axis, i, i, upper, upper ? info.adc_max : info.adc_min};
      while (run.last < x.size() && (upper ? x[run.last][axis] >= run.limit : x[run.last][axis] <= run.limit))
        ++run.last;
      i = run.last - 1;
      runs.push_back(run);
    }
  }
  return runs;
}

double restore_peak(const ClippedRun& run, std::vector<Eigen::Vector3d>& x) {
  if (run.first < 2 || run.last + 1 >= x.size()) return 0.0;
  const double y0 = x[run.first - 1][run.axis];
  const double y1 = x[run.last][run.axis];
  const double length = static_cast<double>(run.last - run.first + 1);
  const double slope0 = length * (y0 - x[run.first - 2][run.axis]);
  const double slope1 = length * (x[run.last + 1][run.axis] - y1);
  double added = 0.0;
  for (std::size_t i = run.first; i < run.last; ++i) {
    const double u = static_cast<double>(i - run.first + 1) / length;
    const double v = 1.0 - u;
    const double cubic = v * v * ((1.0 + 2.0 * u) * y0 + u * slope0) + u * u * ((1.0 + 2.0 * v) * y1 - v * slope1);
    const double excess = run.upper ? std::max(0.0, cubic - run.limit) : std::min(0.0, cubic - run.limit);
    x[i][run.axis] = run.limit + excess;
    added += std::abs(excess) / static_cast<double>(run.last - run.first);
  }
  return added;
}

double restoration_error(const std::vector<Eigen::Vector3d>& x, const RecordingInfo& info, int axis, bool upper) {
  constexpr double kTrialLevel = 0.6;
  constexpr std::size_t kFewest = 20;
  double middle = 0.0;
  for (const Eigen::Vector3d& sample : x) middle += sample[axis] / static_cast<double>(x.size());
  const double limit = upper ? info.adc_max : info.adc_min, level = middle + kTrialLevel * (limit - middle);
  const auto beyond = [&](double value, double than) { return upper ? value >= than : value <= than; };
  std::vector<Eigen::Vector3d> cut = x;
  std::vector<ClippedRun> runs;
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (!beyond(x[i][axis], level)) continue;
    ClippedRun run{axis, i, i, upper, level};
    bool whole = true;
    for (; run.last < x.size() && beyond(x[run.last][axis], level); ++run.last)
      whole = whole && !beyond(x[run.last][axis], limit);
    i = run.last - 1;
    if (!whole || run.last - run.first > kLongestTried) continue;
    runs.push_back(run);
    for (std::size_t j = run.first; j < run.last; ++j) cut[j][axis] = level;
  }
  if (runs.size() < kFewest) return kNan;
  double error_square = 0.0, restored_square = 0.0;
  for (const ClippedRun& run : runs) {
    restore_peak(run, cut);
    double error = 0.0, restored = 0.0;
    for (std::size_t j = run.first; j < run.last; ++j) {
      error += x[j][axis] - cut[j][axis];
      restored += cut[j][axis] - level;
    }
    error_square += error * error;
    restored_square += restored * restored;
  }
  return restored_square > 0.0 ? std::sqrt(error_square / restored_square) : kNan;
}

}  // namespace asperity
