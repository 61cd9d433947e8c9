#include "asperity/texture/make_height_map.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "asperity/base/error.h"
#include "asperity/base/text.h"
#include "asperity/image/gray_image.h"
#include "asperity/texture/evaluate_height.h"
#include "asperity/texture/evaluate_height_map.h"

namespace asperity {
namespace {

// 0 to 1 with neither slope nor curvature at the ends: the blend stays C².
double smootherstep(double x) {
  const double t = std::clamp(x, 0.0, 1.0);
  return t * t * t * (10.0 + t * (6.0 * t - 15.0));
}

// The model over a tile of length_m x width_m, blended near x = 0 and y = 0 where the seams are to close.
struct Tile {
  const TextureModel& model;
  double length_m;
  double width_m;
  double seam_x_m;
  double seam_y_m;

  double row_height_m(double x_m, double y_m) const {
    const double own = evaluate_height(model, x_m, y_m).height_m;
    if (x_m >= seam_x_m) return own;
    const double w = smootherstep(x_m / seam_x_m);
    return w * own + (1.0 - w) * evaluate_height(model, x_m + length_m, y_m).height_m;
  }

  double height_m(double x_m, double y_m) const {
    const double own = row_height_m(x_m, y_m);
    if (y_m >= seam_y_m) return own;
    const double w = smootherstep(y_m / seam_y_m);
    return w * own + (1.0 - w) * row_height_m(x_m, y_m + width_m);
  }
};

// True if the model is the same a distance further on along x (or y), to a millionth of its range.
bool repeats(const TextureModel& model, double dx_m, double dy_m, double length_m, double width_m) {
  constexpr int kProbes = 37;
  double low = evaluate_height(model, 0.0, 0.0).height_m;
  double high = low;
  double worst = 0.0;
  for (int i = 0; i < kProbes; ++i) {
    // The golden ratio's multiples fall evenly and hit no lattice.
    const double x_m = length_m * std::fmod(0.6180339887498949 * (i + 1), 1.0);
    const double y_m = width_m * std::fmod(0.7548776662466927 * (i + 1), 1.0);
    const double here = evaluate_height(model, x_m, y_m).height_m;
    low = std::min(low, here);
    high = std::max(high, here);
    worst = std::max(worst, std::abs(evaluate_height(model, x_m + dx_m, y_m + dy_m).height_m - here));
  }
  return worst <= 1e-6 * (high - low);
}

constexpr std::size_t kMostPixels = std::size_t{kLargestImageSide_px} * kLargestImageSide_px;

}  // namespace

HeightMapFit make_height_map(const TextureModel& model, const MakeHeightMapConfig& config, const Observer& observer) {
  if (!is_height_field(model))
    throw Error("texture: the model " + std::string(kTextureModelNames[model.index()]) + " has no heights");
  if (config.bits != 8 && config.bits != 16)
    throw Error("texture: bits = " + std::to_string(config.bits) + "; 8 or 16 are possible");
  const auto columns = static_cast<std::size_t>(config.columns);
  const auto rows = static_cast<std::size_t>(config.rows);
  if (columns < 4 || rows < 4 || columns * rows > kMostPixels)
    throw Error("texture: an image of " + std::to_string(columns) + " x " + std::to_string(rows) + " pixels");
  const double length_m = config.length_mm > 0.0 ? config.length_mm * 1e-3 : period_m(model).value_or(0.01);
  const double pixel_x_m = length_m / static_cast<double>(columns);
  const double width_m = config.width_mm > 0.0 ? config.width_mm * 1e-3 : pixel_x_m * static_cast<double>(rows);
  const double pixel_y_m = width_m / static_cast<double>(rows);
  const double seam_m = config.seam_mm * 1e-3;
  const bool tiling = config.border == Border::kPeriodic;
  const auto seam_of = [&](double dx_m, double dy_m) {
    if (!tiling || repeats(model, dx_m, dy_m, length_m, width_m)) return 0.0;
    if (2.0 * seam_m > dx_m + dy_m)
      throw Error("texture: a seam of " + number_text(config.seam_mm) + " mm is longer than half the tile");
    return seam_m;
  };
  const Tile tile{model, length_m, width_m, seam_of(length_m, 0.0), seam_of(0.0, width_m)};

  std::vector<double> height_m(columns * rows);
  for (std::size_t r = 0; r < rows; ++r) {
    observer.update("height map", 0.5 * static_cast<double>(r) / static_cast<double>(rows));
    for (std::size_t c = 0; c < columns; ++c)
      height_m[r * columns + c] = tile.height_m(pixel_x_m * static_cast<double>(c), pixel_y_m * static_cast<double>(r));
  }
  const auto [low, high] = std::minmax_element(height_m.begin(), height_m.end());
  HeightMapFit fit;
  HeightMap& map = fit.texture;
  map = {columns, rows, pixel_x_m * 1e3, pixel_y_m * 1e3, *low, *high, config.bits, config.border, {}};
  if (config.range_mm > 0.0) {
    const double middle_m = 0.5 * (*low + *high);
    map.low_m = middle_m - 0.5e-3 * config.range_mm;
    map.high_m = middle_m + 0.5e-3 * config.range_mm;
  }
  fit.quantisation_m = map.metres_per_level();
  const double most = config.bits == 8 ? 255.0 : 65535.0;
  double mean_m = 0.0;
  map.level.reserve(height_m.size());
  for (const double z : height_m) {
    const double level = fit.quantisation_m > 0.0 ? std::round((z - map.low_m) / fit.quantisation_m) : 0.0;
    if (level < 0.0 || level > most) ++fit.clipped;
    map.level.push_back(static_cast<std::uint16_t>(std::clamp(level, 0.0, most)));
    mean_m += z / static_cast<double>(height_m.size());
  }
  double square = 0.0;
  double error = 0.0;
  std::size_t compared = 0;
  for (std::size_t r = 0; r < rows; ++r) {
    observer.update("height map", 0.5 + 0.5 * static_cast<double>(r) / static_cast<double>(rows));
    for (std::size_t c = 0; c < columns; ++c) {
      square += std::pow(height_m[r * columns + c] - mean_m, 2);
      // Half a pixel on, where interpolation is at its worst.
      const double x_m = pixel_x_m * (static_cast<double>(c) + 0.5);
      const double y_m = pixel_y_m * (static_cast<double>(r) + 0.5);
      const bool near_border = !tiling && (c < 2 || r < 2 || c + 3 > columns || r + 3 > rows);
      if (x_m < tile.seam_x_m || y_m < tile.seam_y_m || near_border) continue;
      error += std::pow(evaluate_height(map, x_m, y_m).height_m - evaluate_height(model, x_m, y_m).height_m, 2);
      ++compared;
    }
  }
  fit.rms_height_m = std::sqrt(square / static_cast<double>(height_m.size()));
  fit.rms_error_m = std::sqrt(error / static_cast<double>(std::max<std::size_t>(compared, 1)));
  fit.height_offset_m = -lowest_height_m(map);
  return fit;
}

}  // namespace asperity
