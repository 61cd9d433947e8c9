#pragma once

#include <cstdint>
#include <optional>

#include "asperity/render/texture_force_model.h"
#include "asperity/texture/height_and_gradient.h"
#include "asperity/texture/servo_tables.h"
#include "asperity/texture/texture.h"

namespace asperity {

// How textures are rendered.
struct RenderTextureConfig {
  TextureForceModel model = TextureForceModel::kAuto;
  double cross_fade_s = 0.05;         // after a change of texture or model
  double cutoff_cycles_per_mm = 0.0;  // of the reconstruction filter; 0: none
  double rate_Hz = 1000.0;            // of the servo: a series is made ready for it
  std::int64_t seed = 1;              // of the random models

  // The rate is not a setting of its own: it is the servo's.
  template <class V>
  void visit(V& v) {
    v.choice("model", model, kTextureForceModelNames, "force model; auto: the texture's own");
    v.field("cross_fade_s", cross_fade_s, "after a change of texture, s", {0.0, 10.0});
    v.field("cutoff_cycles_per_mm", cutoff_cycles_per_mm, "of the reconstruction filter; 0: none", {0.0, 1e3});
    v.field("seed", seed, "of the random models", {0.0, 9e15});
  }
};

// A texture made ready for the servo thread: tables instead of series.
struct RenderTexture {
  Texture texture;                                       // as it is rendered, filtered if that was asked for
  TextureForceModel model = TextureForceModel::kHeight;  // not kAuto
  double height_offset_m = 0.0;                          // added to the heights (erratum 20)
  double highest_m = 0.0;                                // no height with it is above; 0 for a series without heights
  double own_stiffness_N_per_m = -1.0;                   // of a series; negative: that of the place
  double cross_fade_s = 0.05;
  std::uint64_t seed = 1;
  // Of what is felt: the same for the same model, numbers and way of rendering, over snapshots too, another for others
  // but for a chance of 2⁻⁶⁴; never 0.
  std::uint64_t id = 0;
  ServoTables tables;                             // of a height field
  std::optional<TextureModel> series_of_heights;  // of a height field that is rendered as a series
};

// Throws Error for a model that the texture's kind cannot serve (a lateral gradient of a series), and for a texture or
// config whose numbers cannot be rendered.
RenderTexture make_render_texture(const Texture& texture, const RenderTextureConfig& config);

// The height H with its offset and its gradient over the texture's coordinates. H is not below the geometric surface:
// where a file's own offset leaves it there, both are 0. All 0 for a texture without heights and for a position that is
// not finite. A Fourier series is within 1e-6 of its RMS height and 1e-4 of its RMS slope of the exact sum; a product
// of two likewise; images and splines are what the texture module evaluates, to rounding. Realtime-safe: yes.
HeightAndGradient render_height(const RenderTexture& texture, double x_m, double y_m) noexcept;

}  // namespace asperity
