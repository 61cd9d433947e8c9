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

std::vector<std::vector<double>> sample_lines(const TextureModel& model, double length_m, double spacing_m) {
  const MeasuredArea area = measured_area(model);
  SampleHeightsConfig line;
  line.length_mm = length_m * 1e3;
  line.spacing_mm = spacing_m * 1e3;
  line.x_mm = 1e3 * area.x_m;
  const double first_mm = 1e3 * area.y_m;
  const std::size_t count = area.width_m > 0.0 ? 16 : 1;
  std::vector<std::vector<double>> lines;
  for (std::size_t i = 0; i < count; ++i) {
    line.y_mm = first_mm + 1e3 * area.width_m * (static_cast<double>(i) + 0.5) / static_cast<double>(count);
    lines.push_back(sample_heights(model, line));
  }
  return lines;
}

}  // namespace asperity
