#pragma once

#include <cstddef>
#include <utility>
#include <variant>

#include "asperity/texture/areal_model.h"
#include "asperity/texture/autoregressive_model.h"
#include "asperity/texture/decaying_sinusoids_model.h"
#include "asperity/texture/fourier1d_model.h"
#include "asperity/texture/fourier2d_model.h"
#include "asperity/texture/height_map_model.h"
#include "asperity/texture/stochastic_model.h"

namespace asperity {

// All texture models, the only place that lists them (docs/texture.md, "A new model").
using TextureModel = std::variant<  //
    Fourier1d,                      //
    Fourier2d,                      //
    HeightMap,                      //
    ArealTexture,                   //
    StochasticTexture,              //
    AutoregressiveTexture,          //
    DecayingSinusoids>;

inline constexpr std::size_t kTextureModelCount = std::variant_size_v<TextureModel>;

// Calls visit.template operator()<Model>() for each model, in the order of the list.
template <class Visit>
constexpr void for_each_texture_model(Visit&& visit) {
  [&]<std::size_t... index>(std::index_sequence<index...>) {
    (visit.template operator()<std::variant_alternative_t<index, TextureModel>>(), ...);
  }
  (std::make_index_sequence<kTextureModelCount>());
}

// The models' names in files, by the index of the variant.
inline constexpr auto kTextureModelNames = [] {
  std::array<std::string_view, kTextureModelCount> names;
  std::size_t k = 0;
  for_each_texture_model([&]<class Model>() { names[k++] = TextureModelTraits<Model>::kName; });
  return names;
}();

}  // namespace asperity
