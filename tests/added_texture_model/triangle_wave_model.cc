#include "triangle_wave_model.h"

#include <algorithm>
#include <cmath>

#include "asperity/texture/texture_fit.h"
#include "asperity/texture/texture_hash.h"
#include "model_block.h"

namespace asperity {

using WaveTraits = TextureModelTraits<TriangleWave>;

void WaveTraits::read_block(const BlockInput& input, TriangleWave& t) {
  t.length_mm = input.block.required("length_mm").number({1e-6, 1e6});
  t.height_m = input.block.required("height_m").number({0.0, kLargestHeight_m});
  input.block.finish();
}

std::string WaveTraits::write_block(const TriangleWave& t, BlockOutput&) {
  JsonWriter block = block_writer();
  block.number("length_mm", t.length_mm);
  block.number("height_m", t.height_m);
  return block.take();
}

Json WaveTraits::describe(const TriangleWave& t) { return {{"length_mm", t.length_mm}, {"height_m", t.height_m}}; }

void WaveTraits::scale(TriangleWave& t, double factor) { t.height_m *= factor; }
void WaveTraits::add_to(TextureHash& hash, const TriangleWave& t) { hash.add(t.length_mm, t.height_m); }

HeightAndGradient WaveTraits::height(const TriangleWave& t, double x_m, double) noexcept {
  const double periods = 1e3 * x_m / t.length_mm;
  const double part = periods - std::floor(periods);
  const double slope = 2.0 * t.height_m / (1e-3 * t.length_mm);
  return part < 0.5 ? HeightAndGradient{2.0 * part * t.height_m, slope, 0.0}
                    : HeightAndGradient{2.0 * (1.0 - part) * t.height_m, -slope, 0.0};
}

double WaveTraits::lowest_m(const TriangleWave&) { return 0.0; }
double WaveTraits::highest_m(const TriangleWave& t) { return t.height_m; }
HeightPeriods WaveTraits::periods_m(const TriangleWave& t) { return {1e-3 * t.length_mm, 0.0}; }
double WaveTraits::length_mm(const TriangleWave& t) { return t.length_mm; }
double WaveTraits::highest_cycles_per_mm(const TriangleWave& t) { return 1.0 / t.length_mm; }

HeightWindow WaveTraits::window(const TriangleWave& t, std::size_t) {
  HeightWindow out;
  out.length_m = out.width_m = 1e-3 * t.length_mm;
  return out;
}

// Of the heights' range.
void WaveTraits::fit(const TextureFitInput& input, const TextureFitOptions& options, FittedTexture& out) {
  const HeightLine line = input.read_heights(input.files);
  const auto [low, high] = std::minmax_element(line.height_m.begin(), line.height_m.end());
  out.texture.model = TriangleWave{options.of<TriangleWave>().length_mm, *high - *low};
  out.report["heights"] = line.height_m.size();
}

}  // namespace asperity
