#pragma once

#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

#include "asperity/signal/resample.h"

namespace asperity {

// Applies `filter` (span of double -> vector of the same size) to each run of x, gaps of at most
// `bridge` points inside a run bridged by straight lines; gaps stay nan.
template <class Filter>
std::vector<double> filter_runs(std::span<const double> x, std::size_t bridge, std::span<const std::size_t> breaks,
                                std::size_t shortest, Filter filter) {
  std::vector<double> out(x.size(), std::numeric_limits<double>::quiet_NaN());
  std::vector<char> breaks_here(x.size(), 0);
  for (const std::size_t i : breaks) {
    if (i < x.size()) breaks_here[i] = 1;
  }
  std::size_t begin = 0;
  while (begin < x.size()) {
    if (!std::isfinite(x[begin])) {
      ++begin;
      continue;
    }
    std::size_t end = begin + 1;
    for (std::size_t i = begin + 1; i < x.size() && i - end <= bridge; ++i) {
      if (breaks_here[i] != 0) break;
      if (std::isfinite(x[i])) end = i + 1;
    }
    if (end - begin >= shortest) {
      const std::vector<double> bridged = bridge_gaps(x.subspan(begin, end - begin));
      const std::vector<double> filtered = filter(std::span<const double>(bridged));
      for (std::size_t i = begin; i < end; ++i) {
        if (std::isfinite(x[i])) out[i] = filtered[i - begin];
      }
    }
    begin = end;
  }
  return out;
}

}  // namespace asperity
