#include "measure_warp.h"

#include <algorithm>
#include <cmath>

#include "asperity/registration/triangle_stretch.h"

namespace asperity {

void measure_warp(const TriangleMesh& mesh, std::span<const std::uint32_t> chosen,
                  const std::vector<HapticTriangle>& triangles, double stretch_limit, HapticWarp& warp) {
  warp.triangles = chosen.size();
  double square = 0.0;
  double area = 0.0;
  bool first = true;
  for (const std::uint32_t t : chosen) {
    const TriangleStretch one = triangle_stretch(mesh, t, triangles[t]);
    if (!one.known) continue;
    warp.stretch_min = first ? one.low : std::min(warp.stretch_min, one.low);
    warp.stretch_max = first ? one.high : std::max(warp.stretch_max, one.high);
    first = false;
    square += one.area_m2 * ((one.high - 1.0) * (one.high - 1.0) + (one.low - 1.0) * (one.low - 1.0)) / 2.0;
    area += one.area_m2;
    if (one.folded) warp.folded.push_back(t);
    if (one.high > stretch_limit || one.low * stretch_limit < 1.0) warp.stretched.push_back(t);
  }
  warp.stretch_rms = area > 0.0 ? std::sqrt(square / area) : 0.0;
}

}  // namespace asperity
