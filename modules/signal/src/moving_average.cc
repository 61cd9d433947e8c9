#include "asperity/signal/moving_average.h"

#include <algorithm>
#include <numeric>

namespace asperity {

std::vector<double> moving_average(std::span<const double> x, std::size_t half_width) {
  const std::size_t n = x.size();
  half_width = std::min(half_width, n);
  std::vector<double> out(n);
  double sum = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t first = i > half_width ? i - half_width : 0;
    const std::size_t last = std::min(i + half_width, n - 1);
    // Summed afresh once a window, so that rounding does not pile up.
    if (i % (2 * half_width + 1) == 0) {
      sum = std::accumulate(x.begin() + static_cast<std::ptrdiff_t>(first),
                            x.begin() + static_cast<std::ptrdiff_t>(last) + 1, 0.0);
    } else {
      if (i + half_width < n) sum += x[i + half_width];
      if (i > half_width) sum -= x[i - half_width - 1];
    }
    out[i] = sum / static_cast<double>(last - first + 1);
  }
  return out;
}

}  // namespace asperity
