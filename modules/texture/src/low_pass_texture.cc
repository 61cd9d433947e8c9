#include "asperity/texture/low_pass_texture.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include "asperity/base/error.h"
#include "asperity/base/text.h"
#include "asperity/texture/synthesize_isotropic.h"
#include "low_pass_grid.h"

namespace asperity {
namespace {

void low_pass(Fourier1d& f, double cutoff_cycles_per_mm) {
  std::size_t kept = 0;
  for (std::size_t j = 0; j < f.a_m.size(); ++j) {
    const double gain = low_pass_gain(static_cast<double>(j + 1) / f.length_mm, cutoff_cycles_per_mm);
    f.a_m[j] *= gain;
    f.b_m[j] *= gain;
    if (gain > 0.0) kept = j + 1;
  }
  // A series without harmonics is no texture to most: one is left, if only at zero.
  kept = std::min(std::max<std::size_t>(kept, 1), f.a_m.size());
  f.a_m.resize(kept);
  f.b_m.resize(kept);
}

void low_pass(SplineGrid& grid, double cutoff_cycles_per_mm) {
  low_pass_grid(grid.coefficient_m, grid.columns, grid.rows, grid.border, cutoff_cycles_per_mm * 1e3 * grid.spacing_x_m,
                cutoff_cycles_per_mm * 1e3 * grid.spacing_y_m);
}

void low_pass(Fourier2d& f, double cutoff_cycles_per_mm) {
  if (f.kind != Fourier2dKind::kIsotropic) {
    low_pass(f.x, cutoff_cycles_per_mm);
    low_pass(f.y, cutoff_cycles_per_mm);
    return;
  }
  IsotropicSpectrum& spectrum = f.isotropic;
  for (std::size_t j = 0; j < spectrum.power_m2.size(); ++j) {
    const double gain = low_pass_gain(static_cast<double>(j + 1) / spectrum.length_mm, cutoff_cycles_per_mm);
    spectrum.power_m2[j] *= gain * gain;
  }
  f.grid = synthesize_isotropic(spectrum);
}

void low_pass(HeightMap& map, double cutoff_cycles_per_mm) {
  const auto unit_m = static_cast<float>(map.metres_per_level());
  std::vector<float> height_m(map.level.size());
  // Heights above low_m: what is small keeps its digits.
  for (std::size_t i = 0; i < height_m.size(); ++i) height_m[i] = unit_m * static_cast<float>(map.level[i]);
  low_pass_grid(height_m, map.columns, map.rows, map.border, cutoff_cycles_per_mm * map.mm_per_px_x,
                cutoff_cycles_per_mm * map.mm_per_px_y);
  const auto [low, high] = std::minmax_element(height_m.begin(), height_m.end());
  const double low_m = *low;
  const double high_m = *high;
  map.high_m = map.low_m + high_m;
  map.low_m += low_m;
  map.bits = 16;
  const double levels_per_m = high_m > low_m ? 65535.0 / (high_m - low_m) : 0.0;
  for (std::size_t i = 0; i < height_m.size(); ++i) {
    const double level = std::round((static_cast<double>(height_m[i]) - low_m) * levels_per_m);
    map.level[i] = static_cast<std::uint16_t>(std::clamp(level, 0.0, 65535.0));
  }
}

void low_pass(ArealTexture& areal, double cutoff_cycles_per_mm) { low_pass(areal.surface, cutoff_cycles_per_mm); }

void low_pass(StochasticTexture& t, double cutoff_cycles_per_mm) {
  t.grain_m = std::max(t.grain_m, 0.5e-3 / cutoff_cycles_per_mm);
}

void low_pass(AutoregressiveTexture&, double) {}
void low_pass(DecayingSinusoids&, double) {}

}  // namespace

double low_pass_gain(double f, double cutoff) {
  const double part = std::abs(f) / cutoff;
  if (part <= 0.5) return 1.0;
  if (!(part < 1.0)) return 0.0;
  const double c = std::cos(std::numbers::pi * (part - 0.5));
  return c * c;
}

Texture low_pass_texture(const Texture& texture, double cutoff_cycles_per_mm) {
  if (!(cutoff_cycles_per_mm > 0.0) || !std::isfinite(cutoff_cycles_per_mm)) {
    throw Error("texture: the cut-off " + number_text(cutoff_cycles_per_mm) +
                " cycles/mm of the reconstruction filter is not a positive number");
  }
  Texture filtered = texture;
  std::visit([&](auto& model) { low_pass(model, cutoff_cycles_per_mm); }, filtered.model);
  if (filtered.band_cycles_per_mm) {
    for (double& end : *filtered.band_cycles_per_mm) end = std::min(end, cutoff_cycles_per_mm);
  }
  return filtered;
}

}  // namespace asperity
