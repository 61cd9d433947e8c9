#include "agree_time_units.h"

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include "row_times.h"

namespace asperity {

namespace {

struct UnitSpan {
  std::string unit;
  TimeSpan span;
};

// The time as it is read first, then in the units that it may have as well where nobody states one.
std::vector<UnitSpan> possible_spans(const ImportTable& table) {
  const MappedColumn* time = find_meaning(table.map, "t");
  std::vector<UnitSpan> out;
  if (time == nullptr) return out;
  if (const auto span = time_span(table)) out.push_back({time->unit, *span});
  if (time->unit_why != "by its values" || find_meaning(table.map, "t2") != nullptr) return out;
  const auto read = find_import_unit(time->unit, Quantity::kTime);
  if (out.empty() || !read || read->is_date) return out;
  for (const char* unit : {"s", "ms", "us", "ns"}) {
    if (unit == time->unit) continue;
    constexpr double kMost_Hz = 6e4;
    const auto span = time_span(table, unit);
    if (span && static_cast<double>(span->rows) <= kMost_Hz * span->length_s()) out.push_back({unit, *span});
  }
  return out;
}

// The common time over that of both together.
double common_share(const TimeSpan& a, const TimeSpan& b) {
  const double common_ns = static_cast<double>(std::min(a.to_ns, b.to_ns) - std::max(a.from_ns, b.from_ns));
  const double all_ns = static_cast<double>(std::max(a.to_ns, b.to_ns) - std::min(a.from_ns, b.from_ns));
  return std::max(0.0, common_ns / all_ns);
}

// Changes the unit of `other`, or of either, or of none.
void agree(ImportTables& tables, const ImportTable& fixed, const ImportTable& other, bool either = false) {
  const auto a = possible_spans(fixed), b = possible_spans(other);
  if (a.empty() || b.empty()) return;
  const double read = common_share(a.front().span, b.front().span);
  double best = read;
  const ImportTable* table = nullptr;
  std::string unit;
  const auto compare = [&](const std::vector<UnitSpan>& spans, const TimeSpan& with, const ImportTable& of) {
    for (const UnitSpan& span : spans) {
      const double share = common_share(span.span, with);
      if (share > best) best = share, table = &of, unit = span.unit;
    }
  };
  compare(b, a.front().span, other);
  if (either) compare(a, b.front().span, fixed);
  constexpr double kLeast = 0.25, kMuchMore = 4.0;
  if (table == nullptr || best < kLeast || best < kMuchMore * read) return;
  set_time_unit(tables, *table, unit, "by the other files");
}

bool is_one_time(const ImportTable& a, const ImportTable& b) {
  const MappedColumn *of_a = find_meaning(a.map, "t"), *of_b = find_meaning(b.map, "t");
  return of_a != nullptr && of_b != nullptr && a.table.file == b.table.file && of_a->column == of_b->column;
}

}  // namespace

void set_time_unit(ImportTables& tables, const ImportTable& table, const std::string& unit, const std::string& why) {
  bool is_told = false;
  for (auto* other : {&tables.pose, &tables.imu, &tables.gyro, &tables.force, &tables.object}) {
    if (!*other || !is_one_time(**other, table)) continue;
    for (MappedColumn& column : (*other)->map) {
      if (column.meaning != "t") continue;
      if (!is_told)
        (*other)->table.problems.push_back(
            {"time_unit",
             fmt::format("{}: {} is read in {}: in {}, as its values alone look, its times would not be those of the "
                         "other files",
                         table.table.file, table.table.describe(column.column), unit, column.unit),
             1});
      is_told = true;
      column.unit = unit;
      column.unit_why = why;
    }
  }
}

void agree_time_units(ImportTables& tables) {
  if (!is_one_time(*tables.pose, *tables.imu)) agree(tables, *tables.imu, *tables.pose, true);
  for (auto* other : {&tables.gyro, &tables.force}) {
    if (*other && !is_one_time(*tables.imu, **other) && !is_one_time(*tables.pose, **other))
      agree(tables, *tables.imu, **other);
  }
  if (tables.object && !is_one_time(*tables.pose, *tables.object)) agree(tables, *tables.pose, *tables.object);
}

}  // namespace asperity
