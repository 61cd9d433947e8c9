#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "asperity/base/units.h"
#include "asperity/import/read_stroke.h"

namespace asperity {

namespace {

constexpr double kLeastRms_mps2 = 1e-4, kMostRms_mps2 = 500.0;
constexpr double kSilent_mps2 = 1e-12;  // an axis that never changes has rounding only, and is noted elsewhere
constexpr double kMostSpeed_mps = 5.0, kMostForce_N = 100.0;

double share_of(std::vector<double> values, double share) {
  if (values.empty()) return 0.0;
  for (double& v : values) v = std::abs(v);
  const auto at = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + at, values.end());
  return values[static_cast<std::size_t>(at)];
}

struct Read {
  const ImportTable* table = nullptr;
  const MappedColumn* column = nullptr;

  std::string text() const {
    return fmt::format("{}: {} read in {}: ", table->table.file, table->table.describe(column->column), column->unit);
  }
};

Read first_of(const std::vector<ImportTable>& tables, ColumnGroup group) {
  for (const ImportTable& table : tables) {
    for (const MappedColumn& column : table.map)
      if (group_of(column.meaning) == group) return {&table, &column};
  }
  return {};
}

double factor_of(const MappedColumn& column) {
  return find_import_unit(column.unit, quantity_of(column.meaning)).value_or(ImportUnit{}).factor;
}

// A unit of `names` in which `size_si`, read in the column's own, would be within [low, high]; "" for none.
std::string unit_within(const Read& read, double size_si, const std::vector<const char*>& names, double low,
                        double high) {
  for (const char* name : names) {
    const auto unit = find_import_unit(name, quantity_of(read.column->meaning));
    const double other = size_si / factor_of(*read.column) * unit.value_or(ImportUnit{}).factor;
    if (name != read.column->unit && other >= low && other <= high) return name;
  }
  return "";
}

std::string state(const Read& read, const std::string& unit) {
  return unit.empty() ? "; state its unit"
                      : fmt::format("; if it is in {}, state {}=…[{}]", unit, read.column->meaning, unit);
}

// The columns of the acceleration, in the order of the tables and of ax, ay, az.
std::vector<Read> acceleration_columns(const std::vector<ImportTable>& tables) {
  std::vector<Read> out;
  for (const ImportTable& table : tables) {
    if (table.role != FileRole::kImu) continue;
    for (const char* meaning : {"ax", "ay", "az"})
      if (const MappedColumn* column = find_meaning(table.map, meaning)) out.push_back({&table, column});
  }
  return out;
}

bool is_guessed(const Read& read) {
  return read.column->unit_why == "by its values" || read.column->unit_why == "assumed";
}

std::string as_unit(const Read& read, const char* unit) { return fmt::format("{}=…[{}]", read.column->meaning, unit); }

void check_acceleration_units(const Stroke& stroke, double mean_mps2, const std::vector<double>& axis_rms_mps2,
                              const std::vector<Read>& axes, std::vector<std::string>& out) {
  constexpr double kNearGravity = 0.1;
  const auto is_gravity = [](double v) { return std::abs(v / kStandardGravity_mps2 - 1.0) < kNearGravity; };
  const bool one_unit = std::all_of(axes.begin(), axes.end(),
                                    [&](const Read& read) { return read.column->unit == axes.front().column->unit; });
  if (stroke.axes == 3 && one_unit && !is_gravity(mean_mps2)) {
    const Read& read = axes.front();
    for (const char* name : {"g", "m/s2", "mg", "gal", "mm/s2"}) {
      const double factor = find_import_unit(name, Quantity::kAcceleration)->factor;
      if (name == read.column->unit || !is_gravity(mean_mps2 / factor_of(*read.column) * factor)) continue;
      out.push_back(read.text() +
                    fmt::format("the mean of its axes has a length of {:.4g} m/s², and would be gravity in "
                                "{}; state {}",
                                mean_mps2, name, as_unit(read, name)));
      return;
    }
  }
  for (std::size_t i = 0; i < axes.size() && i < axis_rms_mps2.size(); ++i) {
    const Read& read = axes[i];
    const double rms = axis_rms_mps2[i];
    if (is_guessed(read) && !(stroke.axes == 3 && is_gravity(mean_mps2))) {
      out.push_back(read.text() + "this is a guess, and gravity is not in it to judge by; state " +
                    as_unit(read, "m/s2") + " or " + as_unit(read, "g"));
    } else if ((rms < kLeastRms_mps2 && rms > kSilent_mps2) || rms > kMostRms_mps2) {
      out.push_back(read.text() +
                    fmt::format("an RMS of {:.3g} m/s² above {:g} Hz is not that of a tool", rms, stroke.high_pass_Hz) +
                    state(read, unit_within(read, rms, {"m/s2", "g", "mg"}, 1e-2, 50.0)));
    }
  }
}

}  // namespace

std::vector<std::string> check_stroke(const Stroke& stroke, double acceleration_mean_mps2,
                                      const std::vector<double>& axis_rms_mps2,
                                      const std::vector<ImportTable>& tables) {
  std::vector<std::string> out;
  check_acceleration_units(stroke, acceleration_mean_mps2, axis_rms_mps2, acceleration_columns(tables), out);
  constexpr double kMost = 0.99;
  if (stroke.speed_is_measured) {
    const Read read = first_of(tables, ColumnGroup::kPosition);
    const double fastest = share_of(stroke.speed_mps, kMost);
    const std::string other = unit_within(read, fastest, {"m", "mm", "um"}, 5e-3, 2.0);
    constexpr double kSlow_mps = 5e-4;
    if (fastest > kMostSpeed_mps || (fastest < kSlow_mps && fastest > 0.0 && !other.empty()))
      out.push_back(read.text() + fmt::format("the tip is as fast as {:.3g} m/s", fastest) + state(read, other));
  }
  if (stroke.force_is_measured) {
    const Read read = first_of(tables, ColumnGroup::kForce);
    const double largest = share_of(stroke.force_N, kMost);
    const std::string other = unit_within(read, largest, {"N", "gf", "mN"}, 0.1, 50.0);
    constexpr double kFaint_N = 0.02;
    const bool is_large_unit = find_import_unit(read.column->unit, Quantity::kForce)->factor >= 1.0;
    if (largest > kMostForce_N || (largest < kFaint_N && largest > 0.0 && !is_large_unit && !other.empty()))
      out.push_back(read.text() + fmt::format("the force is as large as {:.3g} N", largest) + state(read, other));
  }
  return out;
}

}  // namespace asperity
