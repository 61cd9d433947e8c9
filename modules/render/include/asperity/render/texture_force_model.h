#pragma once

#include <optional>
#include <string_view>

namespace asperity {

// How a texture becomes a force.
enum class TextureForceModel {
  kHeight,              // penetration into the height field, along the normal: seed §6.5 (5), errata 19 and 20
  kNormalPerturbation,  // the same along the normal of the height field: Basdogan, Ho and Srinivasan 1997
  kLateralGradient,     // against the slope, within the surface: Minsky 1995
  kStochastic,          // Gaussian, its spread from the heights: Siira and Pai 1996, erratum 27
  kAutoregressive,      // a series by speed and force: Romano and Kuchenbecker 2012
  kDecayingSinusoids,   // on taps and edges: Okamura, Dennerlein and Howe 1998
};

// "height", "normal-perturbation", "lateral-gradient", "stochastic", "autoregressive", "decaying-sinusoids".
std::string_view name_of(TextureForceModel model) noexcept;
std::optional<TextureForceModel> texture_force_model_of(std::string_view name) noexcept;

}  // namespace asperity
