#pragma once

#include <cstdint>
#include <optional>

#include "asperity/render/texture_force_model.h"
#include "asperity/texture/texture.h"

namespace asperity {

// How textures are rendered.
struct RenderTextureConfig {
  std::optional<TextureForceModel> model;  // empty: kHeight for a height field, a series by its own kind
  double cross_fade_s = 0.05;              // after a change of texture or model
  double cutoff_cycles_per_mm = 0.0;       // of the reconstruction filter; 0: none
  std::uint64_t seed = 1;                  // of the random models
};

// A texture made ready for the servo thread: tables instead of series.
struct RenderTexture {
  Texture texture;
  TextureForceModel model = TextureForceModel::kHeight;
  double lift_m = 0.0;     // added to the heights (erratum 20)
  double highest_m = 0.0;  // of the lifted heights
  double cross_fade_s = 0.05;
  std::uint64_t seed = 1;
  std::uint64_t id = 0;  // tells textures and models apart, over snapshots too
};

// Throws Error for a model that the texture's kind cannot serve (a lateral gradient of a series).
RenderTexture make_render_texture(const Texture& texture, const RenderTextureConfig& config);

}  // namespace asperity
