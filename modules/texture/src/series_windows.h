#pragma once

#include <cstddef>
#include <vector>

#include "asperity/texture/fit_autoregressive.h"

namespace asperity {

// A stretch of a recording in which speed and force are taken as constant.
struct SeriesWindow {
  std::size_t first = 0;
  std::size_t count = 0;
  double speed_mps = 0.0;
  double force_N = 0.0;
};

// Throws Error for spans of unequal length, a bad rate, or samples that are not finite.
void check_recording(const SeriesRecording& recording);

// The acceleration without the slow motion of the hand.
std::vector<double> vibration_mps2(const SeriesRecording& recording, const FitAutoregressiveConfig& config);

// The windows that stroke, in order; one that does not is left out.
std::vector<SeriesWindow> stroking_windows(const SeriesRecording& recording, const FitAutoregressiveConfig& config);

// The group of each window, counted from 0 without gaps: k-means in the plane of speed and force, each in units of its
// largest, begun from the farthest points. Groups of fewer than `least` windows are dissolved into their neighbours.
std::vector<int> group_windows(const std::vector<SeriesWindow>& windows, int groups, std::size_t least);

}  // namespace asperity
