#pragma once

#include <limits>
#include <string>
#include <vector>

#include "asperity/json/json.h"
#include "asperity/pipeline/process_result.h"

namespace asperity::app {

// A measured metric of the demonstration beside the true one, in SI units; nan where there is none.
struct DemoMetric {
  static constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

  const char* key;
  const char* title;
  const char* unit;
  double scale;  // from SI to the unit that is printed
  double measured = kNone;
  double standard_error = kNone;
  double lower_bound = kNone;  // instead of `measured`
  double truth = kNone;
};

// Rq of a scan's texture, with its standard error; `true_Rq_m` is that of the true profile.
DemoMetric rq_metric(const ProcessResult& result, double true_Rq_m);

// How far a scan's length is off, of itself, with the length's standard error. The result must have been compared with
// the truth (`accuracy->profile`).
DemoMetric length_error_metric(const ProcessResult& result);

// One line of the table.
std::string metric_line(const DemoMetric& metric);

// An object by key of {measured, stderr, lower_bound, true}.
Json metrics_json(const std::vector<DemoMetric>& metrics);

}  // namespace asperity::app
