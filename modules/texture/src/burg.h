#pragma once

#include <span>
#include <vector>

namespace asperity {

struct BurgResult {
  std::vector<double> k;         // reflection coefficients, all within ±1
  std::vector<double> variance;  // of the error of order 0, 1, …
};

// Burg's method over several segments of one process: each reflection coefficient minimises the sum of forward
// and backward errors of all segments (Burg 1975; de Waele and Broersen 2000). Segments shorter than order + 2 do not
// count.
BurgResult burg(const std::vector<std::span<const double>>& segments, int order);

}  // namespace asperity
