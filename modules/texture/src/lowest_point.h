#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace asperity {

// The lowest value of `height` (a function of grid coordinates u, v) over a grid of columns x rows whose
// neighbours wrap if `periodic`: from each node that is no higher than its neighbours and near the lowest,
// downhill by pattern search to a thousandth of a cell.
template <class Height>
double lowest_from_nodes(std::size_t columns, std::size_t rows, bool periodic, const Height& height) {
  constexpr std::size_t kMostStarts = 4096;
  constexpr double kNear = 0.1;  // of the range: no smooth valley between nodes is deeper
  std::vector<double> node(columns * rows);
  for (std::size_t r = 0; r < rows; ++r) {
    for (std::size_t c = 0; c < columns; ++c)
      node[r * columns + c] = height(static_cast<double>(c), static_cast<double>(r));
  }
  const auto [low, high] = std::minmax_element(node.begin(), node.end());
  double lowest = *low;
  const double reach = *low + kNear * (*high - *low);
  const auto wrapped = [periodic](std::size_t i, int step, std::size_t count) {
    const auto moved = static_cast<std::ptrdiff_t>(i) + step;
    const auto size = static_cast<std::ptrdiff_t>(count);
    if (periodic) return static_cast<std::size_t>((moved + size) % size);
    return static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(moved, 0, size - 1));
  };
  std::size_t starts = 0;
  for (std::size_t r = 0; r < rows; ++r) {
    for (std::size_t c = 0; c < columns; ++c) {
      const double here = node[r * columns + c];
      if (!(here <= reach)) continue;
      bool valley = true;
      for (int dr = -1; dr <= 1 && valley; ++dr) {
        for (int dc = -1; dc <= 1 && valley; ++dc)
          valley = here <= node[wrapped(r, dr, rows) * columns + wrapped(c, dc, columns)];
      }
      if (!valley || ++starts > kMostStarts) continue;
      double u = static_cast<double>(c);
      double v = static_cast<double>(r);
      double best = here;
      for (double step = 0.5; step > 1e-3;) {
        double next = best;
        double next_u = u;
        double next_v = v;
        for (const auto& [du, dv] : {std::pair{step, 0.0}, {-step, 0.0}, {0.0, step}, {0.0, -step}}) {
          const double value = height(u + du, v + dv);
          if (value < next) next = value, next_u = u + du, next_v = v + dv;
        }
        if (next < best) {
          best = next, u = next_u, v = next_v;
        } else {
          step *= 0.5;
        }
      }
      lowest = std::min(lowest, best);
    }
  }
  return lowest;
}

}  // namespace asperity
