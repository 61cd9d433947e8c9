#include "asperity/texture/read_height_image.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "asperity/base/csv.h"
#include "asperity/base/error.h"
#include "asperity/base/text.h"
#include "asperity/image/pgm_image.h"
#include "asperity/image/png_image.h"

namespace asperity {
namespace {

constexpr std::uint64_t kLargestImageFile_bytes = std::uint64_t{1} << 30;
constexpr int kFewestImagePixels = 4;

}  // namespace

Texture parse_height_image(std::string_view data, const std::string& name, const ReadHeightImageConfig& config) {
  if (!(config.width_mm > 0.0) || !std::isfinite(config.width_mm))
    throw Error("height image: a width of " + number_text(config.width_mm) + " mm");
  if (!(config.range_mm >= 0.0) || !std::isfinite(config.range_mm))
    throw Error("height image: a range of heights of " + number_text(config.range_mm) + " mm");
  DeepGrayImage image = data.substr(0, 1) == "P" ? parse_pgm(data, name) : parse_png(data, name);
  if (std::min(image.width, image.height) < kFewestImagePixels) {
    throw Error(name + ": an image of " + std::to_string(image.width) + " x " + std::to_string(image.height) +
                " pixels; a height map has at least " + std::to_string(kFewestImagePixels) + " a side");
  }
  HeightMap map;
  map.columns = static_cast<std::size_t>(image.width);
  map.rows = static_cast<std::size_t>(image.height);
  map.mm_per_px_x = map.mm_per_px_y = config.width_mm / image.width;
  map.low_m = 0.0;
  map.high_m = 1e-3 * config.range_mm;
  map.bits = image.bits;
  map.border = config.border;
  map.level = std::move(image.pixels);
  Texture texture;
  texture.name = name;
  texture.model = std::move(map);
  texture.height_offset_m = 0.0;
  return texture;
}

Texture read_height_image(const std::filesystem::path& path, const ReadHeightImageConfig& config) {
  Texture texture = parse_height_image(read_file(path, kLargestImageFile_bytes), path.string(), config);
  texture.name = path.stem().string();
  return texture;
}

}  // namespace asperity
