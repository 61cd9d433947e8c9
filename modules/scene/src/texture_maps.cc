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
#include "part_observer.h"

namespace asperity {
namespace {

// The mapped part of an area, from its corner at 0 on; it does not repeat.
HeightMap heights_of_area(const TextureModel& model, const SplineGrid& grid, const TextureMapsConfig& config,
                          const Observer& observer) {
  const auto length_mm = [](double origin_m, double spacing_m, std::size_t count) {
    return 1e3 * (origin_m + (static_cast<double>(count) - 3.0) * spacing_m);
  };
  const auto pixels = [&](double mm) {
    return static_cast<int>(
        std::clamp(std::ceil(mm * config.pixels_per_mm), static_cast<double>(config.fewest_pixels), 8192.0));
  };
  MakeHeightMapConfig image;
  image.length_mm = length_mm(grid.origin_x_m, grid.spacing_x_m, grid.columns);
  image.width_mm = length_mm(grid.origin_y_m, grid.spacing_y_m, grid.rows);
  image.columns = pixels(image.length_mm);
  image.rows = pixels(image.width_mm);
  image.border = Border::kClamp;
  return make_height_map(model, image, observer).texture;
}

HeightMap heights_of(const Texture& texture, const TextureMapsConfig& config, const Observer& observer) {
  if (const auto* map = std::get_if<HeightMap>(&texture.model)) return *map;
  if (!is_height_field(texture.model)) {
    throw Error("images: the texture '" + printable(texture.name) + "' of model " + std::string(texture.model_name()) +
                " has no heights");
  }
  if (const auto* areal = std::get_if<ArealTexture>(&texture.model); areal != nullptr && !areal->sigma_m.empty())
    return heights_of_area(texture.model, areal->surface, config, observer);
  const std::optional<double> period = period_m(texture.model);
  const double length_mm = period ? 1e3 * *period : 10.0;
  MakeHeightMapConfig image;
  image.length_mm = length_mm;
  image.columns = static_cast<int>(
      std::clamp(std::ceil(length_mm * config.pixels_per_mm), static_cast<double>(config.fewest_pixels), 8192.0));
  image.rows = config.fewest_pixels;
  image.seam_mm = std::min(config.seam_mm, 0.5 * length_mm);
  return make_height_map(texture.model, image, observer).texture;
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

std::string format_sigma_png(const ArealTexture& areal, const HeightMap& heights, double white_m) {
  const SplineGrid& grid = areal.surface;
  HeightMap image = heights;
  image.low_m = 0.0;
  image.high_m = white_m;
  const auto nearest = [](double at_m, double origin_m, double spacing_m, std::size_t count) {
    const double place = std::round((at_m - origin_m) / spacing_m);
    return static_cast<std::size_t>(std::clamp(place, 0.0, static_cast<double>(count) - 1.0));
  };
  for (std::size_t row = 0; row < image.rows; ++row) {
    const std::size_t r =
        nearest(1e-3 * image.mm_per_px_y * static_cast<double>(row), grid.origin_y_m, grid.spacing_y_m, grid.rows);
    for (std::size_t column = 0; column < image.columns; ++column) {
      const std::size_t c = nearest(1e-3 * image.mm_per_px_x * static_cast<double>(column), grid.origin_x_m,
                                    grid.spacing_x_m, grid.columns);
      const std::size_t i = r * grid.columns + c;
      const double level = areal.supported[i] != 0 ? std::min(areal.sigma_m[i] / white_m, 1.0) * 65534.0 : 65535.0;
      image.level[row * image.columns + column] = static_cast<std::uint16_t>(std::lround(level));
    }
  }
  return format_height_image(image);
}

TextureMaps make_texture_maps(const Texture& texture, const TextureMapsConfig& config, const Observer& observer) {
  TextureMaps out;
  out.heights = heights_of(texture, config, part_observer(observer, "height map", 0.0, 0.8));
  observer.update("height map", 0.8);
  out.height_png = format_height_image(out.heights);
  observer.update("normal map", 0.85);
  out.normal_png = format_normal_png(out.heights);
  out.size_mm = {out.heights.mm_per_px_x * static_cast<double>(out.heights.columns),
                 out.heights.mm_per_px_y * static_cast<double>(out.heights.rows)};
  return out;
}

}  // namespace asperity
