#include "measure_warp.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Dense>

#include "asperity/geometry/flat_triangle.h"

namespace asperity {

void measure_warp(const TriangleMesh& mesh, std::span<const std::uint32_t> chosen,
                  const std::vector<HapticTriangle>& triangles, double stretch_limit, HapticWarp& warp) {
  warp.triangles = chosen.size();
  double square = 0.0;
  double area = 0.0;
  bool first = true;
  for (const std::uint32_t t : chosen) {
    const FlatTriangle flat = flatten(mesh, t);
    Eigen::Matrix2d surface;
    surface << flat.corner[1] - flat.corner[0], flat.corner[2] - flat.corner[0];
    const auto& xy_mm = triangles[t].xy_mm;
    Eigen::Matrix2d texture;
    texture << xy_mm[1] - xy_mm[0], xy_mm[2] - xy_mm[0];
    const Eigen::Matrix2d map = 1e-3 * texture * surface.inverse();
    if (!map.allFinite()) continue;  // without area there is nothing to feel
    // Singular values of a 2 × 2 matrix: half the sum and difference of these two.
    const double sum = std::hypot(map(0, 0) + map(1, 1), map(1, 0) - map(0, 1));
    const double difference = std::hypot(map(0, 0) - map(1, 1), map(1, 0) + map(0, 1));
    const double high = 0.5 * (sum + difference);
    const double low = 0.5 * std::abs(sum - difference);
    warp.stretch_min = first ? low : std::min(warp.stretch_min, low);
    warp.stretch_max = first ? high : std::max(warp.stretch_max, high);
    first = false;
    const double weight = std::abs(surface.determinant());
    square += weight * ((high - 1.0) * (high - 1.0) + (low - 1.0) * (low - 1.0)) / 2.0;
    area += weight;
    if (map.determinant() >= 0.0) warp.folded.push_back(t);
    if (high > stretch_limit || low * stretch_limit < 1.0) warp.stretched.push_back(t);
  }
  warp.stretch_rms = area > 0.0 ? std::sqrt(square / area) : 0.0;
}

}  // namespace asperity
