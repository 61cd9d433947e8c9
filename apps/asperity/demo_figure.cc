#include "demo_figure.h"

#include <fmt/format.h>

#include <cmath>

namespace asperity::app {

std::string figure_line(const DemoFigure& figure) {
  std::string measured = fmt::format("{:.4g}", figure.measured * figure.scale);
  if (std::isfinite(figure.standard_error)) measured += fmt::format(" ± {:.2g}", figure.standard_error * figure.scale);
  if (std::isfinite(figure.lower_bound)) measured = fmt::format("> {:.2g}", figure.lower_bound * figure.scale);
  return fmt::format("  {:<20}{:>18} {:>12.4g}  {}\n", figure.title, measured, figure.truth * figure.scale,
                     figure.unit);
}

Json figures_json(const std::vector<DemoFigure>& figures) {
  Json out;
  for (const DemoFigure& figure : figures) {
    Json& one = out[figure.key];
    one["measured"] = figure.measured;
    if (std::isfinite(figure.standard_error)) one["stderr"] = figure.standard_error;
    if (std::isfinite(figure.lower_bound)) one["lower_bound"] = figure.lower_bound;
    one["true"] = figure.truth;
  }
  return out;
}

}  // namespace asperity::app
