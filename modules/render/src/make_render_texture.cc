#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <variant>

#include "asperity/base/error.h"
#include "asperity/base/text.h"
#include "asperity/render/render_texture.h"
#include "asperity/texture/evaluate_height.h"
#include "asperity/texture/low_pass_texture.h"
#include "asperity/texture/texture_hash.h"

namespace asperity {
namespace {

std::string called(const Texture& texture) {
  return texture.name.empty() ? std::string("texture") : "texture '" + printable(texture.name) + "'";
}

template <class Model>
using ModelTraits = TextureModelTraits<Model>;

template <class Model>
concept TakesHeights = SeriesModel<Model> && requires(Model& model, const Texture& heights) {
  ModelTraits<Model>::take_heights(model, heights);
};

TextureForceModel own_force_model(const TextureModel& model) {
  return std::visit(
      []<class Model>(const Model&) {
        if constexpr (SeriesModel<Model>)
          return kForceModelOf<Model>;
        else
          return TextureForceModel::kHeight;
      },
      model);
}

// The heights of a texture as a series of this kind; nullopt for one that cannot be made of heights.
std::optional<TextureModel> series_of_heights(const Texture& heights, TextureForceModel model) {
  std::optional<TextureModel> series;
  for_each_texture_model([&]<class Model>() {
    if constexpr (TakesHeights<Model>) {
      if (kForceModelOf<Model> != model) return;
      Model made;
      ModelTraits<Model>::take_heights(made, heights);
      series = std::move(made);
    }
  });
  return series;
}

void prepare_series(TextureModel& series, double rate_Hz) {
  std::visit(
      [&]<class Model>(Model& model) {
        if constexpr (requires { ModelTraits<Model>::prepare(model, rate_Hz); })
          ModelTraits<Model>::prepare(model, rate_Hz);
      },
      series);
}

SeriesHeights heights_of_series(const TextureModel& series) {
  return std::visit(
      []<class Model>(const Model& model) -> SeriesHeights {
        if constexpr (requires { ModelTraits<Model>::heights(model); }) return ModelTraits<Model>::heights(model);
        return {};
      },
      series);
}

std::uint64_t texture_id(const RenderTexture& texture) {
  TextureHash hash;
  hash.add(static_cast<std::uint64_t>(texture.texture.model.index()), static_cast<std::uint64_t>(texture.model),
           texture.seed, texture.height_offset_m);
  std::visit([&]<class Model>(const Model& model) { ModelTraits<Model>::add_to(hash, model); }, texture.texture.model);
  return hash.value() == 0 ? 1 : hash.value();
}

void check_finite(const Texture& texture, const char* what, double value) {
  if (!std::isfinite(value)) throw Error(called(texture) + ": " + what + " is " + number_text(value));
}

}  // namespace

RenderTexture make_render_texture(const Texture& source, const RenderTextureConfig& config) {
  RenderTexture result;
  result.texture = config.cutoff_cycles_per_mm == 0.0 ? source : low_pass_texture(source, config.cutoff_cycles_per_mm);
  const Texture& texture = result.texture;
  const bool has_heights = is_height_field(texture.model);
  const TextureForceModel own = own_force_model(texture.model);
  result.model = config.model == TextureForceModel::kAuto ? own : config.model;
  result.cross_fade_s = config.cross_fade_s;
  result.seed = static_cast<std::uint64_t>(config.seed);
  if (has_heights && is_series(result.model)) result.series_of_heights = series_of_heights(texture, result.model);
  const bool can_serve = has_heights ? !is_series(result.model) || result.series_of_heights : result.model == own;
  if (!can_serve) {
    throw Error(called(texture) + ": the model '" + std::string(name_of(result.model)) +
                "' cannot be rendered of a texture of kind '" + std::string(texture.model_name()) + "'");
  }
  if (!(config.cross_fade_s >= 0.0 && config.cross_fade_s <= 10.0))
    throw Error("render: a cross-fade of " + number_text(config.cross_fade_s) + " s is not within 0 and 10 s");
  if (is_series(result.model)) {
    TextureModel& series = result.series_of_heights ? *result.series_of_heights : result.texture.model;
    prepare_series(series, config.rate_Hz);
    const SeriesHeights heights = heights_of_series(series);
    result.height_offset_m = heights.offset_m;
    result.highest_m = heights.highest_m;
    result.own_stiffness_N_per_m = heights.stiffness_N_per_m;
  } else {
    result.height_offset_m = texture.height_offset_m.value_or(height_offset_m(texture.model));
    check_finite(texture, "the height offset", result.height_offset_m);
    const double highest_m = highest_height_m(texture.model) + result.height_offset_m;
    check_finite(texture, "the highest height", highest_m);
    result.highest_m = std::max(highest_m, 0.0);
  }
  result.tables = make_servo_tables(texture.model);
  result.id = texture_id(result);
  return result;
}

}  // namespace asperity
