#pragma once

#include <algorithm>
#include <cstddef>
#include <span>

namespace asperity {

// A density at a frequency, by straight lines between rising frequencies; its first and last value outside them.
inline double spectrum_at(std::span<const double> frequency, std::span<const double> density, double at) {
  const auto above = std::upper_bound(frequency.begin(), frequency.end(), at);
  if (above == frequency.begin()) return density.front();
  if (above == frequency.end()) return density.back();
  const auto b = static_cast<std::size_t>(above - frequency.begin());
  const double share = (at - frequency[b - 1]) / (frequency[b] - frequency[b - 1]);
  return density[b - 1] + share * (density[b] - density[b - 1]);
}

}  // namespace asperity
