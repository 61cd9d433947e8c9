#pragma once

#include <cstddef>

#include "asperity/base/areal_map.h"

namespace asperity {

struct ArealRoughnessConfig {
  bool remove_plane = true;
  double max_missing = 0.5;

  template <class V>
  void visit(V& v) {
    v.field("remove_plane", remove_plane, "subtract the least-squares plane first; otherwise the mean");
    v.field("max_missing", max_missing, "largest part of the heights that may be nan", {0.0, 1.0});
  }
};

// Height parameters of ISO 25178-2:2021; skewness and kurtosis of a flat map are nan.
struct ArealRoughnessResult {
  double Sa_m = 0.0;
  double Sq_m = 0.0;
  double Sz_m = 0.0;  // Sp + Sv
  double Sp_m = 0.0;  // highest point above the mean plane
  double Sv_m = 0.0;  // lowest point below it
  double Ssk = 0.0;
  double Sku = 0.0;
  double slope_x = 0.0;  // of the plane that was removed
  double slope_y = 0.0;
  std::size_t samples = 0;
  std::size_t missing = 0;
};

// Areal height parameters of `map` over its present samples. Throws Error unless the map has at least
// 2×2 points and both spacings, every height is finite or nan, the missing part is small enough, and
// the present points fix a plane.
ArealRoughnessResult measure_areal_roughness(const ArealMap& map, const ArealRoughnessConfig& config = {});

}  // namespace asperity
