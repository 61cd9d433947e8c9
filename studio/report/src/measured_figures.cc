#include "asperity/studio/measured_figures.h"

#include <algorithm>
#include <string>
#include <string_view>

#include "asperity/base/text.h"
#include "figure_rows.h"

namespace asperity::studio {

namespace {

constexpr std::size_t kLongestText = 400;

// What stands at a dotted path; null if nothing does.
const Json* at(const Json& result, std::string_view key) {
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
  const Json* value = at(result, condition.substr(wanted ? 0 : 1));
  return value != nullptr && value->is_boolean() && value->get<bool>() == wanted;
}

Json scaled(const Json& value, double factor) {
  return value.is_number() ? Json(factor * value.get<double>()) : Json(nullptr);
}

Json figure(std::string_view group, const FigureRow& row) {
  Json out{{"group", group}, {"key", row.key}, {"label", row.label}};
  if (!row.hint.empty()) out["hint"] = row.hint;
  return out;
}

void add(const Json& result, std::string_view group, const FigureRow& row, Json& out) {
  const Json* value = at(result, row.key);
  if (value == nullptr || !holds(result, row.only_if)) return;
  Json one = figure(group, row);
  one["unit"] = row.unit;
  switch (row.kind) {
    case FigureKind::kNumber: {
      one["value"] = scaled(*value, row.factor);
      const Json* error = row.error.empty() ? nullptr : at(result, row.error);
      if (error != nullptr && error->is_number()) one["error"] = scaled(*error, row.factor);
      break;
    }
    case FigureKind::kCount:
      one["value"] = value->is_number() ? *value : Json(nullptr);
      one["count"] = true;
      break;
    case FigureKind::kYesNo:
      one["value"] = value->is_boolean() ? Json(value->get<bool>() ? "yes" : "no") : Json(nullptr);
      break;
    case FigureKind::kText:
      if (!value->is_string() || value->text().empty()) return;
      one["value"] = printable(value->text(), kLongestText);
      break;
  }
  out.push_back(std::move(one));
}

}  // namespace

Json measured_figures(const Json& result) {
  Json out = Json::array();
  for (const FigureGroup& group : figure_groups()) {
    for (const FigureRow& row : group.rows) add(result, group.name, row, out);
  }
  return out;
}

}  // namespace asperity::studio
