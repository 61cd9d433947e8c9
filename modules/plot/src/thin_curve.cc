#include "thin_curve.h"

#include <algorithm>
#include <cmath>

namespace asperity {

std::vector<DrawingPoint> thin_curve(std::span<const DrawingPoint> points) {
  std::vector<DrawingPoint> out;
  for (std::size_t begin = 0; begin < points.size();) {
    const double column = std::floor(2.0 * points[begin].x_px);
    std::size_t end = begin + 1, low = begin, high = begin;
    for (; end < points.size() && std::floor(2.0 * points[end].x_px) == column; ++end) {
      if (points[end].y_px < points[low].y_px) low = end;
      if (points[end].y_px > points[high].y_px) high = end;
    }
    std::size_t kept[] = {begin, std::min(low, high), std::max(low, high), end - 1};
    for (std::size_t i = 0; i < 4; ++i)
      if (i == 0 || kept[i] != kept[i - 1]) out.push_back(points[kept[i]]);
    begin = end;
  }
  return out;
}

}  // namespace asperity
