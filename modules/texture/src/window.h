#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace asperity {

// A profile whose short gaps are bridged. `bridged_before[i]` counts the bridged samples before i.
struct BridgedProfile {
  std::vector<double> height_m;
  std::vector<std::size_t> bridged_before;
};

// Bridges gaps of up to `max_gap` samples between present ones by straight lines.
BridgedProfile bridge_short_gaps(std::span<const double> height_m, std::size_t max_gap);

// `count` samples from `first`, with the gap-free stretch around them.
struct Window {
  std::size_t first = 0;
  std::size_t count = 0;
  std::size_t stretch_first = 0;
  std::size_t stretch_end = 0;

  bool found() const { return count > 0; }
};

// The best window of `count` samples (see fit_fourier1d), compared over `seam` samples on either side
// of its ends; not found() if no stretch is long enough.
Window best_window(const BridgedProfile& profile, std::size_t count, std::size_t seam);

// The longest gap-free stretch, the first of equals.
Window longest_stretch(const BridgedProfile& profile);

// The window's heights with the end blended into the start over `seam` samples: with what follows the
// window if there is enough of it, else with what precedes it, else by bending both ends to their mean.
std::vector<double> close_seam(const BridgedProfile& profile, const Window& window, std::size_t seam);

}  // namespace asperity
