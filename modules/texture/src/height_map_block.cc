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
  JsonObject& block = input.block;
  const auto most = static_cast<std::int64_t>(kLargestImageSide_px);
  map.columns = static_cast<std::size_t>(block.required("columns").integer(kFewestPixels, most));
  map.rows = static_cast<std::size_t>(block.required("rows").integer(kFewestPixels, most));
  map.bits = static_cast<int>(block.required("bits").integer(8, 16));
  if (map.bits != 8 && map.bits != 16) block.fail("bits", "is neither 8 nor 16");
  const auto pixel_mm = block.required("mm_per_px").numbers(2, {-1e6, 1e6});
  if (pixel_mm.size() != 2 || !(pixel_mm[0] >= 1e-9) || !(pixel_mm[1] >= 1e-9))
    block.fail("mm_per_px", "is not [x, y] of at least 1e-9 mm");
  map.mm_per_px_x = pixel_mm[0];
  map.mm_per_px_y = pixel_mm[1];
  map.low_m = block.required("low_m").number(kHeights_m);
  map.high_m = block.required("high_m").number({map.low_m, kLargestHeight_m});
  map.border = static_cast<Border>(block.required("border").choice(kBorderNames));
  const JsonItem file = block.required("file");
  block.finish();
  const std::string content = input.read_payload(".png");
  DeepGrayImage image;
  try {
    image = parse_png(content, file.text());
  } catch (const Error& error) {
    file.fail(error.what());
  }
  if (static_cast<std::size_t>(image.width) != map.columns || static_cast<std::size_t>(image.height) != map.rows ||
      image.bits != map.bits) {
    file.fail("the image has " + std::to_string(image.width) + " x " + std::to_string(image.height) + " pixels of " +
              std::to_string(image.bits) + " bits, the block states " + std::to_string(map.columns) + " x " +
              std::to_string(map.rows) + " of " + std::to_string(map.bits));
  }
  map.level = std::move(image.pixels);
}

std::string TextureModelTraits<HeightMap>::write_block(const HeightMap& map, BlockOutput& output) {
  if (!(map.high_m >= map.low_m)) throw Error("texture: a height map whose highest height is below its lowest");
  const std::string file = output.add_payload(".heights.png", format_height_image(map));
  JsonWriter block = block_writer();
  block.text("file", file);
  block.integer("columns", static_cast<std::int64_t>(map.columns));
  block.integer("rows", static_cast<std::int64_t>(map.rows));
  block.integer("bits", map.bits);
  block.numbers("mm_per_px", {map.mm_per_px_x, map.mm_per_px_y});
  block.number("low_m", map.low_m);
  block.number("high_m", map.high_m);
  block.text("border", kBorderNames.at(static_cast<std::size_t>(map.border)));
  return block.take();
}

}  // namespace asperity
