#include "asperity/studio/measured_metrics.h"

#include <algorithm>
#include <string>
#include <string_view>

#include "asperity/base/text.h"
#include "metric_rows.h"

namespace asperity::studio {

namespace {

constexpr std::size_t kLongestText = 400;

// The value at a dotted path; null if there is none.
const Json* value_at(const Json& result, std::string_view key) {
  const Json* place = &result;
  while (place != nullptr && !key.empty()) {
    const std::size_t dot = std::min(key.find('.'), key.size());
    place = place->find(key.substr(0, dot));
    key.remove_prefix(std::min(dot + 1, key.size()));
  }
  return place;
}

bool holds(const Json& result, std::string_view condition) {
  if (condition.empty()) return true;
  const bool wanted = !condition.starts_with('!');
  const Json* value = value_at(result, condition.substr(wanted ? 0 : 1));
  return value != nullptr && value->is_boolean() && value->get<bool>() == wanted;
}

Json scaled(const Json& value, double factor) {
  return value.is_number() ? Json(factor * value.get<double>()) : Json(nullptr);
}

Json metric_json(std::string_view group, const MetricRow& row) {
  Json out{{"group", group}, {"key", row.key}, {"label", row.label}};
  if (!row.hint.empty()) out["hint"] = row.hint;
  return out;
}

void append_metric(const Json& result, std::string_view group, const MetricRow& row, Json& out) {
  const Json* value = value_at(result, row.key);
  if (value == nullptr || !holds(result, row.only_if)) return;
  Json one = metric_json(group, row);
  one["unit"] = row.unit;
  switch (row.kind) {
    case MetricKind::kNumber: {
      one["value"] = scaled(*value, row.factor);
      const Json* error = row.error.empty() ? nullptr : value_at(result, row.error);
      if (error != nullptr && error->is_number()) one["error"] = scaled(*error, row.factor);
      break;
    }
    case MetricKind::kCount:
      one["value"] = value->is_number() ? *value : Json(nullptr);
      one["count"] = true;
      break;
    case MetricKind::kYesNo:
      one["value"] = value->is_boolean() ? Json(value->get<bool>() ? "yes" : "no") : Json(nullptr);
      break;
    case MetricKind::kText:
      if (!value->is_string() || value->text().empty()) return;
      one["value"] = printable(value->text(), kLongestText);
      break;
  }
  out.push_back(std::move(one));
}

}  // namespace

Json measured_metrics(const Json& result) {
  Json out = Json::array();
  for (const MetricGroup& group : metric_groups()) {
    for (const MetricRow& row : group.rows) append_metric(result, group.name, row, out);
  }
  return out;
}

}  // namespace asperity::studio
