#include "asperity/texture/height_map_model.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>

#include "asperity/texture/evaluate_height_map.h"
#include "asperity/texture/fourier2d_model.h"
#include "asperity/texture/make_height_map.h"
#include "asperity/texture/texture_file.h"
#include "asperity/texture/texture_fit.h"
#include "asperity/texture/texture_hash.h"
#include "low_pass_grid.h"

namespace asperity {

using MapTraits = TextureModelTraits<HeightMap>;

Json MapTraits::describe(const HeightMap& map) {
  return {{"columns", map.columns},
          {"rows", map.rows},
          {"bits", map.bits},
          {"mm_per_px", {map.mm_per_px_x, map.mm_per_px_y}},
          {"low_m", map.low_m},
          {"high_m", map.high_m},
          {"quantisation_m", map.metres_per_level()},
          {"border", kBorderNames.at(static_cast<std::size_t>(map.border))}};
}

void MapTraits::scale(HeightMap& map, double factor) {
  map.low_m *= factor;
  map.high_m *= factor;
}

void MapTraits::add_to(TextureHash& hash, const HeightMap& m) {
  hash.add(static_cast<std::uint64_t>(m.columns), static_cast<std::uint64_t>(m.rows), m.mm_per_px_x, m.mm_per_px_y,
           m.low_m, m.high_m, static_cast<std::uint64_t>(m.bits), static_cast<std::uint64_t>(m.border), m.level);
}

void MapTraits::low_pass(HeightMap& map, double cutoff_cycles_per_mm) {
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

std::size_t MapTraits::size_bytes(const HeightMap& map) { return map.level.size() * sizeof(map.level[0]); }

HeightAndGradient MapTraits::height(const HeightMap& map, double x_m, double y_m) noexcept {
  return evaluate_height(map, x_m, y_m);
}

double MapTraits::lowest_m(const HeightMap& map) { return lowest_height_m(map); }

double MapTraits::highest_m(const HeightMap& map) {
  HeightMap upside_down = map;
  const int top = map.bits == 8 ? 255 : 65535;
  for (std::uint16_t& level : upside_down.level) level = static_cast<std::uint16_t>(top - level);
  upside_down.low_m = -map.high_m;
  upside_down.high_m = -map.low_m;
  return -lowest_height_m(upside_down);
}

HeightPeriods MapTraits::periods_m(const HeightMap& map) {
  if (map.border != Border::kPeriodic) return {};
  return {1e-3 * map.mm_per_px_x * static_cast<double>(map.columns),
          1e-3 * map.mm_per_px_y * static_cast<double>(map.rows)};
}

HeightWindow MapTraits::window(const HeightMap& map, std::size_t most_cells) {
  HeightWindow out;
  out.columns = std::min(map.columns, most_cells);
  out.rows = std::min(map.rows, most_cells);
  out.length_m = static_cast<double>(out.columns) * 1e-3 * map.mm_per_px_x;
  out.width_m = static_cast<double>(out.rows) * 1e-3 * map.mm_per_px_y;
  return out;
}

double MapTraits::highest_cycles_per_mm(const HeightMap& map) {
  return 0.5 / std::min(map.mm_per_px_x, map.mm_per_px_y);
}

void MapTraits::make_tables(const HeightMap& map, ServoTables& tables) {
  tables.grid = {1e3 / map.mm_per_px_x, 1e3 / map.mm_per_px_y, 0.0, 0.0, map.metres_per_level(), map.low_m};
}

void MapTraits::fit(const TextureFitInput& input, const TextureFitOptions& options, FittedTexture& out) {
  if (input.is_texture_file(input.files.front())) {
    if (input.files.size() > 1) throw TextureFitFilesError("heightmap takes one texture");
    out.texture = read_texture(input.files.front());
  } else {
    TextureModelTraits<Fourier2d>::fit(input, options, out);
  }
  HeightMapFit fit = make_height_map(out.texture.model, options.of<HeightMap>().heightmap, input.observer);
  out.report["map_rms_m"] = fit.rms_height_m;
  out.report["map_rms_error_m"] = fit.rms_error_m;
  out.report["quantisation_m"] = fit.quantisation_m;
  if (fit.clipped > 0)
    out.add_problems({{"clipped", std::to_string(fit.clipped) + " pixels lie outside the range", fit.clipped}});
  out.texture.model = std::move(fit.texture);
}

}  // namespace asperity
