#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "asperity/base/problem.h"
#include "asperity/texture/spline_grid.h"
#include "asperity/texture/texture.h"

namespace asperity {

struct ReadHeightImageConfig {
  double width_mm = 10.0;
  double range_mm = 2.5;
  Border border = Border::kMirror;

  template <class V>
  void visit(V& v) {
    v.field("width_mm", width_mm, "of the image along its rows; pixels are square", {1e-3, 1e6});
    v.field("range_mm", range_mm, "height of white over black", {0.0, 1e6});
    v.choice("border", border, kBorderNames, "beyond the image");
  }
};

// An image as a height map (thesis §6.5, Fig. 38: 10 mm, 2.5 mm from black to white): a PNG, a JPEG, a TIFF, or a PGM,
// P5 or P2, of up to 16 bits; its first bytes say which. Black is 0, and the height offset is 0: an image without black
// begins higher. Other than gray of 8 or 16 bits (a palette, colours, fewer bits, transparency, JPEG) is converted to
// its brightness (convert_png), a TIFF of other numbers to 16 bits from its lowest to its highest; which `problems`, if
// given, gets as "converted_image". The texture is named after the file. Throws Error naming the file for one that
// cannot be read or is not such an image, is smaller than 4 x 4 or larger than png_image.h allows, and for a config out
// of range.
Texture read_height_image(const std::filesystem::path& path, const ReadHeightImageConfig& config = {},
                          Problems* problems = nullptr);

// The same from memory; `name` is what messages call it.
Texture parse_height_image(std::string_view data, const std::string& name, const ReadHeightImageConfig& config = {},
                           Problems* problems = nullptr);

}  // namespace asperity
