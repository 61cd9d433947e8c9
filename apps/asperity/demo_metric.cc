#include "demo_metric.h"

#include <fmt/format.h>

#include <cmath>

namespace asperity::app {

std::string metric_line(const DemoMetric& metric) {
  std::string measured = fmt::format("{:.4g}", metric.measured * metric.scale);
  if (std::isfinite(metric.standard_error)) measured += fmt::format(" ± {:.2g}", metric.standard_error * metric.scale);
  if (std::isfinite(metric.lower_bound)) measured = fmt::format("> {:.2g}", metric.lower_bound * metric.scale);
  return fmt::format("  {:<20}{:>18} {:>12.4g}  {}\n", metric.title, measured, metric.truth * metric.scale,
                     metric.unit);
}

Json metrics_json(const std::vector<DemoMetric>& metrics) {
  Json out;
  for (const DemoMetric& metric : metrics) {
    Json& one = out[metric.key];
    one["measured"] = metric.measured;
    if (std::isfinite(metric.standard_error)) one["stderr"] = metric.standard_error;
    if (std::isfinite(metric.lower_bound)) one["lower_bound"] = metric.lower_bound;
    one["true"] = metric.truth;
  }
  return out;
}

}  // namespace asperity::app
