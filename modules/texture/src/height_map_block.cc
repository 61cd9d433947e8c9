#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "asperity/base/error.h"
#include "asperity/image/png_image.h"
#include "asperity/texture/format_height_image.h"
#include "block_json.h"
#include "model_block.h"

namespace asperity {
namespace {

constexpr std::int64_t kFewestPixels = 4;

}  // namespace

void TextureModelTraits<HeightMap>::read_block(const BlockInput& input, HeightMap& map) {
  const LocatedJson& json = input.json;
  const std::string& path = input.path;
  json.only(path, {"file", "columns", "rows", "bits", "mm_per_px", "low_m", "high_m", "border"});
  const auto most = std::int64_t{kLargestImageSide_px};
  map.columns = static_cast<std::size_t>(required_integer(json, path, "columns", kFewestPixels, most));
  map.rows = static_cast<std::size_t>(required_integer(json, path, "rows", kFewestPixels, most));
  map.bits = static_cast<int>(required_integer(json, path, "bits", 8, 16));
  if (map.bits != 8 && map.bits != 16) json.fail(path + ".bits", "is neither 8 nor 16");
  const auto pixel_mm = required_numbers(json, path, "mm_per_px", 1e6, 2);
  if (pixel_mm.size() != 2 || !(pixel_mm[0] >= 1e-9) || !(pixel_mm[1] >= 1e-9))
    json.fail(path + ".mm_per_px", "is not [x, y] of at least 1e-9 mm");
  map.mm_per_px_x = pixel_mm[0];
  map.mm_per_px_y = pixel_mm[1];
  map.low_m = required_number(json, path, "low_m", -kLargestHeight_m, kLargestHeight_m);
  map.high_m = required_number(json, path, "high_m", map.low_m, kLargestHeight_m);
  map.border = static_cast<Border>(required_choice(json, path, "border", {kBorderNames.begin(), kBorderNames.end()}));
  const std::string content = input.read_payload(".png");
  DeepGrayImage image;
  try {
    image = parse_png(content, json.find(path, "file")->get<std::string>());
  } catch (const Error& error) {
    json.fail(path + ".file", error.what());
  }
  if (static_cast<std::size_t>(image.width) != map.columns || static_cast<std::size_t>(image.height) != map.rows ||
      image.bits != map.bits) {
    json.fail(path + ".file", "the image has " + std::to_string(image.width) + " x " + std::to_string(image.height) +
                                  " pixels of " + std::to_string(image.bits) + " bits, the block says " +
                                  std::to_string(map.columns) + " x " + std::to_string(map.rows) + " of " +
                                  std::to_string(map.bits));
  }
  map.level = std::move(image.pixels);
}

std::string TextureModelTraits<HeightMap>::write_block(const HeightMap& map, BlockOutput& output) {
  if (!(map.high_m >= map.low_m)) throw Error("texture: a height map whose highest height is below its lowest");
  const std::string file = output.add_payload(".heights.png", format_height_image(map));
  return BlockText()
      .add("file", text_json(file, "file"))
      .add("columns", std::to_string(map.columns))
      .add("rows", std::to_string(map.rows))
      .add("bits", std::to_string(map.bits))
      .add("mm_per_px", std::vector<double>{map.mm_per_px_x, map.mm_per_px_y})
      .add("low_m", map.low_m)
      .add("high_m", map.high_m)
      .add("border", "\"" + std::string(kBorderNames.at(static_cast<std::size_t>(map.border))) + "\"")
      .str();
}

}  // namespace asperity
