#include <algorithm>
#include <array>
#include <cmath>

#include "asperity/base/error.h"
#include "asperity/base/units.h"
#include "asperity/import/guess_columns.h"
#include "column_words.h"

namespace asperity {

namespace {

// The k-th of the finite values by size, k as a share; nan if there is none.
double share_of_values(const DelimitedColumn& column, double share) {
  std::vector<double> values;
  for (const double value : column.values) {
    if (std::isfinite(value)) values.push_back(std::abs(value));
  }
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  const auto at = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + at, values.end());
  return values[static_cast<std::size_t>(at)];
}

std::optional<ImportUnit> unit_in_name(const std::string& name, Quantity quantity) {
  const auto split = split_unit_of_name(name);
  return split ? find_import_unit(split->unit, quantity) : std::nullopt;
}

std::string time_unit_by_values(const DelimitedColumn& column) {
  std::vector<double> steps;
  for (std::size_t i = 1; i < column.values.size(); ++i) {
    const double step = column.values[i] - column.values[i - 1];
    if (step > 0.0) steps.push_back(step);
  }
  constexpr std::array<std::pair<const char*, double>, 4> kUnits{
      {{"s", 1.0}, {"ms", 1e-3}, {"us", 1e-6}, {"ns", 1e-9}}};
  const double size = share_of_values(column, 0.0);
  constexpr double kYear2001_s = 1e9, kYear2033_s = 2e9;
  for (const auto& [unit, factor] : kUnits) {
    if (size * factor > kYear2001_s && size * factor < kYear2033_s) return unit;
  }
  if (steps.empty()) return "s";
  std::nth_element(steps.begin(), steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2), steps.end());
  const double step = steps[steps.size() / 2];
  constexpr double kLongest_s = 0.25;  // 4 Hz
  for (const auto& [unit, factor] : kUnits) {
    if (step * factor <= kLongest_s) return unit;
  }
  return "ns";
}

std::string acceleration_unit_by_values(double size) {
  constexpr std::array<std::pair<const char*, double>, 4> kRests{
      {{"m/s2", kStandardGravity_mps2}, {"g", 1.0}, {"mg", 1000.0}, {"gal", 100.0 * kStandardGravity_mps2}}};
  const char* best = "m/s2";
  double least = std::numeric_limits<double>::infinity();
  for (const auto& [unit, rest] : kRests) {
    const double away = std::abs(std::log(size / rest));
    if (away < least) least = away, best = unit;
  }
  return best;
}

}  // namespace

void guess_units(const DelimitedTable& table, ColumnMap& map) {
  // The size of a group is that of its three axes together.
  const auto size_of = [&](ColumnGroup group, Quantity quantity) {
    double sum = 0.0;
    for (const MappedColumn& mapped : map) {
      if (group_of(mapped.meaning) != group || quantity_of(mapped.meaning) != quantity) continue;
      constexpr double kMedian = 0.5, kMost = 0.99;
      const double size =
          share_of_values(table.columns[mapped.column], quantity == Quantity::kAcceleration ? kMedian : kMost);
      if (std::isfinite(size)) sum += size * size;
    }
    return std::sqrt(sum);
  };
  for (MappedColumn& mapped : map) {
    const Quantity quantity = quantity_of(mapped.meaning);
    if (!mapped.unit.empty()) continue;
    const DelimitedColumn& column = table.columns[mapped.column];
    mapped.unit_why = "by its values";
    if (quantity == Quantity::kNumber) {
      mapped.unit = "1";
      mapped.unit_why.clear();
    } else if (!column.unit.empty()) {
      mapped.unit = parse_import_unit(column.unit, quantity, table.file + ": " + table.describe(mapped.column)).name;
      mapped.unit_why = "header";
    } else if (const auto unit = unit_in_name(column.name, quantity)) {
      mapped.unit = unit->name;
      mapped.unit_why = "its name";
    } else if (quantity == Quantity::kTime) {
      mapped.unit = column.has_text ? "iso" : time_unit_by_values(column);
    } else if (quantity == Quantity::kLength) {
      constexpr double kLargest_m = 20.0;
      mapped.unit = size_of(ColumnGroup::kPosition, quantity) > kLargest_m ? "mm" : "m";
    } else if (quantity == Quantity::kAngle) {
      constexpr double kLargest_rad = 12.0;
      mapped.unit = size_of(ColumnGroup::kRotation, quantity) > kLargest_rad ? "deg" : "rad";
    } else if (quantity == Quantity::kRate) {
      constexpr double kLargest_radps = 35.0;  // 2000 °/s
      mapped.unit = size_of(ColumnGroup::kRate, quantity) > kLargest_radps ? "deg/s" : "rad/s";
    } else if (quantity == Quantity::kAcceleration) {
      mapped.unit = acceleration_unit_by_values(size_of(ColumnGroup::kAcceleration, quantity));
    } else {
      mapped.unit = "N";
      mapped.unit_why = "assumed";
    }
  }
}

}  // namespace asperity
