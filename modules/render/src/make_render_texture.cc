#include <algorithm>
#include <cmath>
#include <string>
#include <variant>

#include "asperity/base/error.h"
#include "asperity/base/text.h"
#include "asperity/render/render_texture.h"
#include "asperity/texture/convert_rate.h"
#include "asperity/texture/evaluate_height.h"
#include "asperity/texture/low_pass_texture.h"
#include "highest_height.h"
#include "make_grains.h"
#include "make_tables.h"
#include "texture_id.h"

namespace asperity {
namespace {

std::string called(const Texture& texture) {
  return texture.name.empty() ? std::string("texture") : "texture '" + printable(texture.name) + "'";
}

TextureForceModel own_model(const TextureModel& model) {
  if (std::holds_alternative<StochasticTexture>(model)) return TextureForceModel::kStochastic;
  if (std::holds_alternative<AutoregressiveTexture>(model)) return TextureForceModel::kAutoregressive;
  if (std::holds_alternative<DecayingSinusoids>(model)) return TextureForceModel::kDecayingSinusoids;
  return TextureForceModel::kHeight;
}

bool serves(const TextureModel& texture, TextureForceModel model) {
  if (!is_height_field(texture)) return model == own_model(texture);
  return model != TextureForceModel::kAutoregressive && model != TextureForceModel::kDecayingSinusoids;
}

void check_finite(const Texture& texture, const char* what, double value) {
  if (!std::isfinite(value)) throw Error(called(texture) + ": " + what + " is " + number_text(value));
}

AutoregressiveTexture at_rate(const AutoregressiveTexture& series, double rate_Hz) {
  if (!(rate_Hz >= 1.0 && rate_Hz <= 1e6))
    throw Error("render: a rate of " + number_text(rate_Hz) + " Hz is not within 1 and 1e6 Hz");
  return series.rate_Hz == rate_Hz ? series : convert_rate(series, {.rate_Hz = rate_Hz});
}

}  // namespace

RenderTexture make_render_texture(const Texture& source, const RenderTextureConfig& config) {
  RenderTexture result;
  result.texture = config.cutoff_cycles_per_mm == 0.0 ? source : low_pass_texture(source, config.cutoff_cycles_per_mm);
  const Texture& texture = result.texture;
  result.model = config.model.value_or(own_model(texture.model));
  result.cross_fade_s = config.cross_fade_s;
  result.seed = config.seed;
  if (!serves(texture.model, result.model)) {
    throw Error(called(texture) + ": the model '" + std::string(name_of(result.model)) +
                "' cannot be rendered of a texture of kind '" + std::string(texture.model_name()) + "'");
  }
  if (!(config.cross_fade_s >= 0.0 && config.cross_fade_s <= 10.0))
    throw Error("render: a cross-fade of " + number_text(config.cross_fade_s) + " s is not within 0 and 10 s");
  if (auto* series = std::get_if<AutoregressiveTexture>(&result.texture.model))
    *series = at_rate(*series, config.rate_Hz);
  if (result.model == TextureForceModel::kStochastic) make_grains(result);
  if (is_height_field(texture.model) && result.model != TextureForceModel::kStochastic) {
    result.lift_m = texture.lift_m.value_or(lift_m(texture.model));
    check_finite(texture, "the lift", result.lift_m);
    const double highest_m = highest_height_m(texture.model) + result.lift_m;
    check_finite(texture, "the highest height", highest_m);
    result.highest_m = std::max(highest_m, 0.0);
  }
  make_tables(result);
  result.id = texture_id(result);
  return result;
}

}  // namespace asperity
