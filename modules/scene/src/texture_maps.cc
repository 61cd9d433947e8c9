#include "asperity/scene/texture_maps.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "asperity/base/error.h"
#include "asperity/base/text.h"
#include "asperity/image/png_image.h"
#include "asperity/texture/evaluate_height.h"
#include "asperity/texture/evaluate_height_map.h"
#include "asperity/texture/format_height_image.h"
#include "asperity/texture/make_height_map.h"

namespace asperity {
namespace {

HeightMap heights_of(const Texture& texture, const TextureMapsConfig& config) {
  if (const auto* map = std::get_if<HeightMap>(&texture.model)) return *map;
  if (!is_height_field(texture.model)) {
    throw Error("images: the texture '" + printable(texture.name) + "' of model " + std::string(texture.model_name()) +
                " has no heights");
  }
  const std::optional<double> period = period_m(texture.model);
  const double length_mm = period ? 1e3 * *period : 10.0;
  MakeHeightMapConfig image;
  image.length_mm = length_mm;
  image.columns = static_cast<int>(
      std::clamp(std::ceil(length_mm * config.pixels_per_mm), static_cast<double>(config.fewest_pixels), 8192.0));
  image.rows = config.fewest_pixels;
  image.seam_mm = std::min(config.seam_mm, 0.5 * length_mm);
  return make_height_map(texture.model, image).texture;
}

}  // namespace

std::string format_normal_png(const HeightMap& heights) {
  std::vector<std::uint16_t> samples;
  samples.reserve(3 * heights.columns * heights.rows);
  const auto encode = [&samples](double component) {
    samples.push_back(static_cast<std::uint16_t>(std::lround((component * 0.5 + 0.5) * 65535.0)));
  };
  for (std::size_t row = 0; row < heights.rows; ++row) {
    for (std::size_t column = 0; column < heights.columns; ++column) {
      const HeightAndGradient g = evaluate_height(heights, 1e-3 * heights.mm_per_px_x * static_cast<double>(column),
                                                  1e-3 * heights.mm_per_px_y * static_cast<double>(row));
      const double scale = 1.0 / std::sqrt(1.0 + g.slope_x * g.slope_x + g.slope_y * g.slope_y);
      encode(-g.slope_x * scale);
      encode(g.slope_y * scale);
      encode(scale);
    }
  }
  return format_rgb_png(static_cast<int>(heights.columns), static_cast<int>(heights.rows), samples);
}

TextureMaps make_texture_maps(const Texture& texture, const TextureMapsConfig& config) {
  TextureMaps out;
  out.heights = heights_of(texture, config);
  out.height_png = format_height_image(out.heights);
  out.normal_png = format_normal_png(out.heights);
  out.size_mm = {out.heights.mm_per_px_x * static_cast<double>(out.heights.columns),
                 out.heights.mm_per_px_y * static_cast<double>(out.heights.rows)};
  return out;
}

}  // namespace asperity
