#pragma once

#include <array>
#include <string_view>

namespace asperity {

// The force model of all textures; auto is each texture's own.
enum class TextureModelChoice {
  kAuto,
  kHeight,
  kNormalPerturbation,
  kLateralGradient,
  kStochastic,
  kAutoregressive,
  kDecayingSinusoids
};
inline constexpr std::array<std::string_view, 7> kTextureModelChoices{
    "auto", "height", "normal-perturbation", "lateral-gradient", "stochastic", "autoregressive", "decaying-sinusoids"};

}  // namespace asperity
