#include <algorithm>
#include <limits>
#include <variant>

#include "asperity/device/cap_scene.h"

namespace asperity {
namespace {

double highest(const Fourier1d& series) { return static_cast<double>(series.a_m.size()) / series.length_mm; }

double highest(const SplineGrid& grid) { return 0.5e-3 / std::min(grid.spacing_x_m, grid.spacing_y_m); }

double highest(const Fourier2d& series) {
  if (series.kind != Fourier2dKind::kIsotropic) return std::max(highest(series.x), highest(series.y));
  return static_cast<double>(series.isotropic.power_m2.size()) / series.isotropic.length_mm;
}

double highest(const HeightMap& map) { return 0.5 / std::min(map.mm_per_px_x, map.mm_per_px_y); }

double highest(const ArealTexture& areal) { return highest(areal.surface); }

// A series in time has no heights.
template <class Series>
double highest(const Series& /*series*/) {
  return std::numeric_limits<double>::infinity();
}

}  // namespace

double highest_cycles_per_mm(const Texture& texture) {
  if (texture.band_cycles_per_mm) return (*texture.band_cycles_per_mm)[1];
  return std::visit([](const auto& model) { return highest(model); }, texture.model);
}

}  // namespace asperity
