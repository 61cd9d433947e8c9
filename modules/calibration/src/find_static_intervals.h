#pragma once

#include <vector>

#include "asperity/calibration/calibrate_tracker_noise.h"

namespace asperity {

// Rows [first, last) of a tracker stream.
struct PoseRange {
  std::size_t first = 0;
  std::size_t last = 0;
};

// The longest stretch that a recording has, and what ended it: how far the mean pose over a block was from the
// stretch's; zero where the recording or a gap ended it.
struct LongestRest {
  double length_s = 0.0;
  double moved_m = 0.0;
  double rotated_rad = 0.0;
};

// The stretches, in order and apart, in which the mean poses over blocks stay together; the first and last block of
// each stretch, where the motion may begin, is left away. Those too short for the config are not among them.
// `longest`, where it is given, keeps the longest of all, with its first and last block, and what it has already.
std::vector<PoseRange> find_static_intervals(const TrackerStream& tracker, const TrackerNoiseConfig& config,
                                             LongestRest* longest = nullptr);

// The chordal mean of rotations that are near each other.
Eigen::Quaterniond mean_rotation(const TrackerStream& tracker, PoseRange range);

}  // namespace asperity
