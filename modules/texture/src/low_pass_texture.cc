#include "asperity/texture/low_pass_texture.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <variant>

#include "asperity/base/error.h"
#include "asperity/base/text.h"

namespace asperity {
double low_pass_gain(double f, double cutoff) {
  const double part = std::abs(f) / cutoff;
  if (part <= 0.5) return 1.0;
  if (!(part < 1.0)) return 0.0;
  const double c = std::cos(std::numbers::pi * (part - 0.5));
  return c * c;
}

Texture low_pass_texture(const Texture& texture, double cutoff_cycles_per_mm) {
  if (!(cutoff_cycles_per_mm > 0.0) || !std::isfinite(cutoff_cycles_per_mm)) {
    throw Error("texture: the cut-off " + number_text(cutoff_cycles_per_mm) +
                " cycles/mm of the reconstruction filter is not a positive number");
  }
  Texture filtered = texture;
  std::visit(
      [&]<class Model>(Model& model) {
        if constexpr (requires { TextureModelTraits<Model>::low_pass(model, cutoff_cycles_per_mm); })
          TextureModelTraits<Model>::low_pass(model, cutoff_cycles_per_mm);
      },
      filtered.model);
  if (filtered.band_cycles_per_mm) {
    for (double& end : *filtered.band_cycles_per_mm) end = std::min(end, cutoff_cycles_per_mm);
  }
  return filtered;
}

}  // namespace asperity
