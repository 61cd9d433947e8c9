#include "asperity/texture/texture_fit.h"

namespace asperity {

FittedTexture fit_texture(FittedModelChoice choice, const TextureFitInput& input, const TextureFitOptions& options) {
  FittedTexture out;
  auto k = static_cast<int>(choice);
  for_each_texture_model([&]<class Model>() {
    if constexpr (FittedModel<Model>) {
      if (k-- == 0) TextureModelTraits<Model>::fit(input, options, out);
    }
  });
  return out;
}

}  // namespace asperity
