#include "demo_metric.h"

#include <fmt/format.h>

#include <cmath>

#include "asperity/base/interval_text.h"

namespace asperity::app {

DemoMetric rq_metric(const ProcessResult& result, double true_Rq_m) {
  DemoMetric metric{"Rq_m", "Rq", "µm", 1e6};
  metric.truth = true_Rq_m;
  if (!result.roughness) return metric;
  metric.measured = result.roughness->Rq_m;
  metric.standard_error = result.roughness->standard_error.Rq_m;
  return metric;
}

DemoMetric length_error_metric(const ProcessResult& result) {
  DemoMetric metric{"length_error", "length error", "%", 1e2};
  metric.measured = 1e-2 * result.accuracy->profile->length_error_percent;
  metric.standard_error = result.noise.length_stderr_m / result.coverage.length_m;
  metric.truth = 0.0;
  return metric;
}

std::string metric_line(const DemoMetric& metric) {
  std::string measured = interval_text(metric.measured * metric.scale, metric.standard_error * metric.scale, 2, 4);
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
