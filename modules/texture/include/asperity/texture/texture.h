#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <variant>

#include "asperity/texture/areal_texture.h"
#include "asperity/texture/autoregressive.h"
#include "asperity/texture/decaying_sinusoids.h"
#include "asperity/texture/fourier1d.h"
#include "asperity/texture/fourier2d.h"
#include "asperity/texture/height_map.h"
#include "asperity/texture/stochastic.h"

namespace asperity {

// What a texture was made from and by.
struct TextureSource {
  std::string recording;
  std::string config_json;  // the resolved config; empty if unknown
  std::string version;
};

// The models, and in the same order their names in the file.
using TextureModel = std::variant<Fourier1d, Fourier2d, HeightMap, ArealTexture, StochasticTexture,
                                  AutoregressiveTexture, DecayingSinusoids>;
inline constexpr std::array<std::string_view, 7> kTextureModelNames{
    "fourier1d", "fourier2d", "heightmap", "areal", "stochastic", "autoregressive", "decaying_sinusoids"};
static_assert(kTextureModelNames.size() == std::variant_size_v<TextureModel>);

// A haptic texture, the content of a *.texture.json and of the image or table that it names.
struct Texture {
  std::string name;
  TextureModel model;

  std::optional<double> compliance_kc;                      // k_c, within 0 and 1 (seed §5.3)
  std::optional<double> stiffness_N_per_m;                  // overrides the scene's
  std::optional<double> friction;                           // coefficient; overrides the scene's
  std::optional<double> lift_m;                             // added to the height (erratum 20)
  std::map<std::string, double> roughness;                  // by name: Ra_m, Rq_m, RSm_m, Rsk, …
  std::optional<std::array<double, 2>> band_cycles_per_mm;  // low, high
  TextureSource source;
  std::string extra_json = "{}";

  std::string_view model_name() const { return kTextureModelNames[model.index()]; }
};

}  // namespace asperity
