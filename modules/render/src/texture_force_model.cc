#include "asperity/render/texture_force_model.h"

#include <array>
#include <cstddef>

namespace asperity {
namespace {

constexpr std::array<std::string_view, 6> kNames{"height",     "normal-perturbation", "lateral-gradient",
                                                 "stochastic", "autoregressive",      "decaying-sinusoids"};

}  // namespace

std::string_view name_of(TextureForceModel model) noexcept { return kNames[static_cast<std::size_t>(model)]; }

std::optional<TextureForceModel> texture_force_model_of(std::string_view name) noexcept {
  for (std::size_t k = 0; k < kNames.size(); ++k) {
    if (kNames[k] == name) return static_cast<TextureForceModel>(k);
  }
  return std::nullopt;
}

}  // namespace asperity
