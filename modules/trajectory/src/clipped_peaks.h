#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "asperity/recording/recording.h"

namespace asperity {

constexpr std::size_t kLongestTried = 12;  // samples: of a peak that is restored as those that were tried

// One axis' run of samples at the converter's limit, from `first` to before `last`.
struct ClippedRun {
  int axis = 0;
  std::size_t first = 0;
  std::size_t last = 0;
  bool upper = true;
  double limit = 0.0;
};

// All runs of an accelerometer's counts at the ends of the converter's range.
std::vector<ClippedRun> find_clipped(const std::vector<Eigen::Vector3d>& x, const RecordingInfo& info);

// Puts a cubic through the samples beside a clipped run, with their slopes, where the converter cut the
// peak off; returns the mean height of what it added, counts. A sensor's low-pass makes peaks that smooth.
double restore_peak(const ClippedRun& run, std::vector<Eigen::Vector3d>& x);

// How far restored peaks are from the true ones, over what was restored: found on whole peaks of the same axis and side
// that are cut at 0.6 of the range and restored in the same way. nan: too few of them.
double restoration_error(const std::vector<Eigen::Vector3d>& x, const RecordingInfo& info, int axis, bool upper);

}  // namespace asperity
