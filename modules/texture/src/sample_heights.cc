#include "asperity/texture/sample_heights.h"

#include <cmath>
#include <numbers>
#include <string>

#include "asperity/base/error.h"
#include "asperity/base/text.h"
#include "asperity/texture/evaluate_height.h"

namespace asperity {

std::vector<double> sample_heights(const TextureModel& model, const SampleHeightsConfig& config) {
  constexpr double kMost = 1e8;
  if (!is_height_field(model))
    throw Error("texture: the model " + std::string(kTextureModelNames[model.index()]) + " has no heights");
  const double count = std::round(config.length_mm / config.spacing_mm);
  if (!(config.spacing_mm > 0.0) || !(count >= 1.0) || !(count <= kMost)) {
    throw Error("texture: a line of " + number_text(config.length_mm) + " mm in steps of " +
                number_text(config.spacing_mm) + " mm does not have 1 to " + number_text(kMost) + " heights");
  }
  const double angle = config.direction_deg * std::numbers::pi / 180.0;
  std::vector<double> height_m(static_cast<std::size_t>(count));
  for (std::size_t i = 0; i < height_m.size(); ++i) {
    const double s_mm = static_cast<double>(i) * config.spacing_mm;
    const double x_m = 1e-3 * (config.x_mm + s_mm * std::cos(angle));
    const double y_m = 1e-3 * (config.y_mm + s_mm * std::sin(angle));
    height_m[i] = evaluate_height(model, x_m, y_m).height_m;
  }
  return height_m;
}

}  // namespace asperity
