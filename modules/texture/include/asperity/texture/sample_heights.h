#pragma once

#include <vector>

#include "asperity/texture/texture.h"

namespace asperity {

struct SampleHeightsConfig {
  double length_mm = 40.0;
  double spacing_mm = 0.025;
  double x_mm = 0.0;
  double y_mm = 0.0;
  double direction_deg = 0.0;

  template <class V>
  void visit(V& v) {
    v.field("length_mm", length_mm, "of the line", {1e-6, 1e6});
    v.field("spacing_mm", spacing_mm, "between heights", {1e-9, 1e6});
    v.field("x_mm", x_mm, "where the line begins, along the scan path", {-1e6, 1e6});
    v.field("y_mm", y_mm, "and across it", {-1e6, 1e6});
    v.field("direction_deg", direction_deg, "of the line; 0: along the scan path", {-360.0, 360.0});
  }
};

// Heights of a height field along a straight line, its height offset not added: round(length / spacing) of them. Throws
// Error for a model that is not a height field, a step that is not positive, or more than 10⁸ heights.
std::vector<double> sample_heights(const TextureModel& model, const SampleHeightsConfig& config = {});

// Lines along x through a height field, where its roughness is measured: one if it is the same for every y, else
// sixteen across measured_area(). Throws as above.
std::vector<std::vector<double>> sample_lines(const TextureModel& model, double length_m, double spacing_m);

}  // namespace asperity
