#include "asperity/texture/texture_operations.h"

#include <variant>

namespace asperity {

Json describe_texture_model(const TextureModel& model) {
  return std::visit([]<class Model>(const Model& m) { return TextureModelTraits<Model>::describe(m); }, model);
}

void scale_texture_model(TextureModel& model, double factor) {
  std::visit([&]<class Model>(Model& m) { TextureModelTraits<Model>::scale(m, factor); }, model);
}

bool reseed_texture_model(TextureModel& model, std::int64_t seed) {
  return std::visit(
      [&]<class Model>(Model& m) {
        if constexpr (requires { TextureModelTraits<Model>::reseed(m, seed); })
          return TextureModelTraits<Model>::reseed(m, seed);
        else
          return SeriesModel<Model>;  // a series takes the seed of its stroke
      },
      model);
}

std::uint64_t size_bytes(const Texture& texture) {
  std::uint64_t size = sizeof(Texture);
  std::visit(
      [&]<class Model>(const Model& m) {
        if constexpr (requires { TextureModelTraits<Model>::size_bytes(m); })
          size += TextureModelTraits<Model>::size_bytes(m);
      },
      texture.model);
  return size;
}

}  // namespace asperity
