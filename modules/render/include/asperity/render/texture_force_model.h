#pragma once

#include <array>
#include <cstddef>
#include <string_view>

#include "asperity/texture/texture_models.h"

namespace asperity {

// How a texture becomes a force. After these come the series models, each in its own way, in the order of the texture
// models: kForceModelOf<Series>.
enum class TextureForceModel {
  kAuto,                // kHeight for a height field, a series in its own way
  kHeight,              // penetration into the height field, along the normal: thesis §6.5 (5), errata 19 and 20
  kNormalPerturbation,  // the same along the normal of the height field: Basdogan, Ho and Srinivasan 1997
  kLateralGradient,     // against the slope, within the surface: Minsky 1995
};

namespace detail {

inline constexpr std::array<std::string_view, 4> kHeightForceNames{"auto", "height", "normal-perturbation",
                                                                   "lateral-gradient"};

template <class Wanted>
constexpr TextureForceModel force_model_of() {
  std::size_t value = kHeightForceNames.size();
  std::size_t found = value;
  for_each_texture_model([&]<class Model>() {
    if constexpr (std::is_same_v<Model, Wanted>) found = value;
    if constexpr (SeriesModel<Model>) ++value;
  });
  return static_cast<TextureForceModel>(found);
}

constexpr std::size_t count_series_models() {
  std::size_t count = 0;
  for_each_texture_model([&]<class Model>() { count += SeriesModel<Model>; });
  return count;
}

}  // namespace detail

template <SeriesModel Series>
inline constexpr TextureForceModel kForceModelOf = detail::force_model_of<Series>();

// True for a model of forces in time: all after those of height fields.
constexpr bool is_series(TextureForceModel model) noexcept { return model > TextureForceModel::kLateralGradient; }

// "auto", "height", "normal-perturbation", "lateral-gradient", then the series models' kForceName.
inline constexpr auto kTextureForceModelNames = [] {
  std::array<std::string_view, detail::kHeightForceNames.size() + detail::count_series_models()> names;
  std::size_t k = 0;
  for (const std::string_view name : detail::kHeightForceNames) names[k++] = name;
  for_each_texture_model([&]<class Model>() {
    if constexpr (SeriesModel<Model>) names[k++] = TextureModelTraits<Model>::kForceName;
  });
  return names;
}();

constexpr std::string_view name_of(TextureForceModel model) noexcept {
  return kTextureForceModelNames[static_cast<std::size_t>(model)];
}

}  // namespace asperity
