#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "asperity/texture/spline_grid.h"

namespace asperity {

// Where in the grid a coordinate falls, and d(inside)/d(coordinate).
struct Inside {
  double u = 0.0;
  double du = 1.0;
};

// max(t, 0) with its corner rounded: C¹, a parabola for |t| < 1.
inline Inside rounded_ramp(double t) {
  if (t >= 1.0) return {t, 1.0};
  if (t <= -1.0) return {0.0, 0.0};
  return {0.25 * (t + 1.0) * (t + 1.0), 0.5 * (t + 1.0)};
}

// |t| with its corner rounded: C¹, a parabola for |t| < 1.
inline Inside rounded_fold(double t) {
  if (t >= 1.0) return {t, 1.0};
  if (t <= -1.0) return {-t, -1.0};
  return {0.5 * (t * t + 1.0), t};
}

// Brings a coordinate (in cells) into [low, high], or, for a periodic grid of `high - low` cells, into
// [low, high). At least two cells are between them; u must be finite.
inline Inside to_inside(double u, double low, double high, Border border) noexcept {
  const double span = high - low;
  if (border == Border::kPeriodic) {
    const double t = u - low;
    const double r = t - span * std::floor(t / span);
    return {low + (r >= span || r < 0.0 ? 0.0 : r), 1.0};
  }
  if (border == Border::kClamp) {
    const Inside above = rounded_ramp(u - low);
    const Inside below = rounded_ramp(span - above.u);
    return {std::clamp(high - below.u, low, high), below.du * above.du};
  }
  const double period = 2.0 * span;
  double t = u - low;
  t -= period * std::floor(t / period + 0.5);  // [-span, span]
  const Inside fold = rounded_fold(t);
  const Inside far = rounded_fold(span - fold.u);
  // Far out, where a period is below rounding, the fold may miss.
  return {std::clamp(high - far.u, low, high), far.du * fold.du};
}

// Four neighbouring indices from `first` on, brought into the grid.
struct Neighbours {
  std::size_t index[4];
};

inline Neighbours neighbours(std::ptrdiff_t first, std::size_t count, Border border) noexcept {
  Neighbours n{};
  const auto size = static_cast<std::ptrdiff_t>(count);
  for (std::ptrdiff_t k = 0; k < 4; ++k) {
    std::ptrdiff_t i = first + k;
    if (border == Border::kPeriodic) {
      i = i < 0 ? i + size : i >= size ? i - size : i;
    }
    n.index[k] = static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(i, 0, size - 1));
  }
  return n;
}

}  // namespace asperity
