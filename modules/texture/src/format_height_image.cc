#include "asperity/texture/format_height_image.h"

#include <algorithm>

#include "asperity/image/png_image.h"

namespace asperity {

std::string format_height_image(const HeightMap& map) {
  // One more than is allowed is refused by format_png, which says so.
  constexpr std::size_t kTooMany = kLargestImageSide_px + 1;
  return format_png(DeepGrayImage{static_cast<int>(std::min(map.columns, kTooMany)),
                                  static_cast<int>(std::min(map.rows, kTooMany)), map.level, map.bits});
}

}  // namespace asperity
