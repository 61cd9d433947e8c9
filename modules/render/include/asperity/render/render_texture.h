#pragma once

#include <cstdint>
#include <optional>

#include "asperity/render/grid_scale.h"
#include "asperity/render/periodic_table.h"
#include "asperity/render/texture_force_model.h"
#include "asperity/texture/height_and_gradient.h"
#include "asperity/texture/texture.h"

namespace asperity {

// How textures are rendered.
struct RenderTextureConfig {
  std::optional<TextureForceModel> model;  // empty: kHeight for a height field, a series by its own kind
  double cross_fade_s = 0.05;              // after a change of texture or model
  double cutoff_cycles_per_mm = 0.0;       // of the reconstruction filter; 0: none
  double rate_Hz = 1000.0;                 // of the servo: autoregressive textures are converted to it
  std::uint64_t seed = 1;                  // of the random models
};

// A texture made ready for the servo thread: tables instead of series.
struct RenderTexture {
  Texture texture;  // as it is rendered, filtered if that was asked for
  TextureForceModel model = TextureForceModel::kHeight;
  double lift_m = 0.0;     // added to the heights (erratum 20)
  double highest_m = 0.0;  // no lifted height is above it; 0 for a series without heights
  double cross_fade_s = 0.05;
  std::uint64_t seed = 1;
  std::uint64_t id = 0;   // tells textures and models apart, over snapshots too; never 0
  PeriodicTable x_table;  // of a Fourier1d, or of the factors of a Fourier2d; empty: evaluated exactly
  PeriodicTable y_table;
  GridScale grid;            // of an image or a spline
  StochasticTexture grains;  // of kStochastic: the texture's own or those of its heights, for a stiffness of 1 N/m
  double grain_stiffness_N_per_m = -1.0;  // of kStochastic; negative: that of the place
};

// Throws Error for a model that the texture's kind cannot serve (a lateral gradient of a series), and for a texture or
// config whose numbers cannot be rendered.
RenderTexture make_render_texture(const Texture& texture, const RenderTextureConfig& config);

// The lifted height H and its gradient over the texture's coordinates. H is not below the geometric surface: where a
// file's own lift leaves it there, both are 0. All 0 for a texture without heights and for a position that is not
// finite. A Fourier series is within 1e-6 of its RMS height and 1e-4 of its RMS slope of the exact sum; a product of
// two likewise; images and splines are what the texture module evaluates, to rounding. Realtime-safe: yes.
HeightAndGradient render_height(const RenderTexture& texture, double x_m, double y_m) noexcept;

}  // namespace asperity
