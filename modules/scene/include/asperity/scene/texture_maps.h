#pragma once

#include <string>

#include <Eigen/Core>

#include "asperity/base/progress.h"
#include "asperity/texture/areal_texture.h"
#include "asperity/texture/height_map.h"
#include "asperity/texture/texture.h"

namespace asperity {

struct TextureMapsConfig {
  double pixels_per_mm = 20.0;
  int fewest_pixels = 256;
  double seam_mm = 0.5;

  template <class V>
  void visit(V& v) {
    v.field("pixels_per_mm", pixels_per_mm, "of images made from other models", {0.01, 1e4});
    v.field("fewest_pixels", fewest_pixels, "a side, for any length", {4, 8192});
    v.field("seam_mm", seam_mm, "over which a tile's end passes over into its start", {0.0, 1e6});
  }
};

// A texture as images of 16 bits that tile: heights, and the normals of the same pixels.
struct TextureMaps {
  HeightMap heights;
  std::string height_png;  // grey: black is heights.low_m, white heights.high_m
  std::string normal_png;  // RGB: see format_normal_png
  Eigen::Vector2d size_mm = Eigen::Vector2d::Zero();
};

// Images of a texture that is a height field; the image of one that is an image already. An area (an areal texture with
// standard deviations) is one image from its corner on that does not tile. Throws Error for other models.
TextureMaps make_texture_maps(const Texture& texture, const TextureMapsConfig& config = {},
                              const Observer& observer = {});

// The unit normals of a height map at its pixels, each component c as (c + 1)/2 · 65535: red along x, green against y
// (up the image), blue outwards, as glTF 2.0 takes a normal map. The slopes are those of the texture as it is rendered.
std::string format_normal_png(const HeightMap& heights);

// The standard deviations of an area's heights at the pixels of its height map, grey of 16 bits: black is 0, level
// 65534 is `white_m`, and level 65535 is a hole, where nothing is known of the height.
std::string format_sigma_png(const ArealTexture& areal, const HeightMap& heights, double white_m);

}  // namespace asperity
