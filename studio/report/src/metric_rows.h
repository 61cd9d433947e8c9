#pragma once

#include <span>
#include <string_view>

namespace asperity::studio {

enum class MetricKind { kNumber, kCount, kYesNo, kText };

// How one metric of result.json is shown: value times `factor` in `unit`.
struct MetricRow {
  std::string_view key;  // its position in result.json, dotted
  std::string_view label;
  std::string_view unit{};
  double factor = 1.0;
  std::string_view error{};    // the place of its standard error
  std::string_view only_if{};  // the place of a truth value that it needs; with '!' before it: one that must be false
  std::string_view hint{};     // what the label does not say
  MetricKind kind = MetricKind::kNumber;
};

struct MetricGroup {
  std::string_view name;
  std::span<const MetricRow> rows;
};

// All groups, in the order in which they are shown.
std::span<const MetricGroup> metric_groups();

}  // namespace asperity::studio
