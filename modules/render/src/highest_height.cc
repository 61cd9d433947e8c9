#include "highest_height.h"

#include <cstdint>
#include <variant>

#include "asperity/texture/evaluate_height.h"

namespace asperity {
namespace {

void negate(Fourier1d& f) {
  for (double& a : f.a_m) a = -a;
  for (double& b : f.b_m) b = -b;
  f.mean_m = -f.mean_m;
}

void negate(SplineGrid& grid) {
  for (double& c : grid.coefficient_m) c = -c;
}

void negate(Fourier2d& f) {
  f.scale_per_m = -f.scale_per_m;
  f.offset_m = -f.offset_m;
  negate(f.grid);
}

void negate(HeightMap& map) {
  const int top = map.bits == 8 ? 255 : 65535;
  for (std::uint16_t& level : map.level) level = static_cast<std::uint16_t>(top - level);
  const double low_m = map.low_m;
  map.low_m = -map.high_m;
  map.high_m = -low_m;
}

void negate(ArealTexture& t) { negate(t.surface); }

}  // namespace

double highest_height_m(const TextureModel& model) {
  TextureModel upside_down = model;
  std::visit(
      []<class Model>(Model& m) {
        if constexpr (requires { negate(m); }) negate(m);
      },
      upside_down);
  return -lowest_height_m(upside_down);
}

}  // namespace asperity
