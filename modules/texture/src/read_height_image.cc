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
#include "asperity/image/read_gray_image.h"
#include "asperity/image/tiff_image.h"

namespace asperity {
namespace {

constexpr std::uint64_t kLargestImageFile_bytes = std::uint64_t{1} << 30;
constexpr int kFewestImagePixels = 4;

// The levels of a TIFF: whole numbers of 8 and 16 bits as they are, others from their lowest to their highest in 16
// bits.
DeepGrayImage levels_of(const TiffImage& image, const std::string& name, std::string& note) {
  if (image.columns > kLargestImageSide_px || image.rows > kLargestImageSide_px)
    throw Error(name + ": " + std::to_string(image.columns) + " x " + std::to_string(image.rows) +
                " pixels are too many");
  DeepGrayImage out;
  out.width = static_cast<int>(image.columns);
  out.height = static_cast<int>(image.rows);
  out.bits = 16;
  double low = 0.0;
  double high = 65535.0;
  if (!image.is_float && !image.is_signed && image.bits <= 16) {
    out.bits = image.bits;
    high = image.bits == 8 ? 255.0 : 65535.0;
  } else {
    for (const double value : image.values)
      if (!std::isfinite(value)) throw Error(name + ": has missing points (nan), which a height map has not");
    const auto [least, most] = std::minmax_element(image.values.begin(), image.values.end());
    low = *least;
    high = *most > low ? *most : low + 1.0;
    if (!std::isfinite(high - low) || !(high > low))
      throw Error(name + ": its numbers span more than a height map can");
    note = "numbers of " + std::to_string(image.bits) + " bits, of which " + number_text(low) + " is black and " +
           number_text(high) + " white";
  }
  const double scale = (out.bits == 8 ? 255.0 : 65535.0) / (high - low);
  for (const double value : image.values)
    out.pixels.push_back(static_cast<std::uint16_t>(std::lround((value - low) * scale)));
  return out;
}

// The image in gray; what was converted is a problem.
DeepGrayImage read_image(std::string_view data, const std::string& name, Problems* problems) {
  if (data.substr(0, 1) == "P") return parse_pgm(data, name);
  std::string note;
  DeepGrayImage out;
  if (is_tiff(data)) {
    out = levels_of(parse_tiff(data, name), name, note);
  } else if (data.starts_with("\xff\xd8\xff")) {
    const GrayImage jpeg = decode_gray_image({reinterpret_cast<const unsigned char*>(data.data()), data.size()}, name);
    out.width = jpeg.width;
    out.height = jpeg.height;
    out.bits = jpeg.bits;
    out.pixels.assign(jpeg.pixels.begin(), jpeg.pixels.end());
    note = "JPEG, whose 8 bits are rounded by its compression";
  } else {
    out = convert_png(data, name, note);
  }
  if (!note.empty() && problems != nullptr) {
    problems->push_back({"converted_image",
                         printable(name, 200) + ": is not a plain image of heights; it has " + note +
                             "; its brightness counts as height, in " + std::to_string(out.bits) + " bits",
                         1});
  }
  return out;
}

}  // namespace

Texture parse_height_image(std::string_view data, const std::string& name, const ReadHeightImageConfig& config,
                           Problems* problems) {
  if (!(config.width_mm > 0.0) || !std::isfinite(config.width_mm))
    throw Error("height image: a width of " + number_text(config.width_mm) + " mm");
  if (!(config.range_mm >= 0.0) || !std::isfinite(config.range_mm))
    throw Error("height image: a range of heights of " + number_text(config.range_mm) + " mm");
  DeepGrayImage image = read_image(data, name, problems);
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

Texture read_height_image(const std::filesystem::path& path, const ReadHeightImageConfig& config, Problems* problems) {
  Texture texture = parse_height_image(read_file(path, kLargestImageFile_bytes), path.string(), config, problems);
  texture.name = path.stem().string();
  return texture;
}

}  // namespace asperity
