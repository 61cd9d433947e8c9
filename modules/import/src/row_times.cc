#include "row_times.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>

#include <fmt/format.h>
#include "asperity/base/error.h"
#include "asperity/base/text.h"
#include "parse_time.h"

namespace asperity {

namespace {

using RowTimes = std::vector<std::optional<std::int64_t>>;

struct ClockRange {
  std::int64_t ns;
  const char* name;
};
constexpr std::array<ClockRange, 3> kClockRanges{{{(std::int64_t{1} << 32) * 1'000, "2^32 µs"},
                                                  {(std::int64_t{1} << 32) * 1'000'000, "2^32 ms"},
                                                  {std::int64_t{86'400} * 1'000'000'000, "24 h"}}};

std::optional<std::int64_t> time_of_cell(const ImportTable& in, const MappedColumn& mapped, const ImportUnit& unit,
                                         std::size_t row) {
  const std::string_view cell = in.table.cell(row, mapped.column);
  if (is_missing_cell(cell)) return std::nullopt;
  const auto t_ns = unit.is_date ? parse_date_time_ns(cell) : parse_decimal_ns(cell, unit.ns);
  if (!t_ns) fail_at(in.table, row, mapped.column, unit.is_date ? "is not a date and time" : "is not a time");
  return t_ns;
}

std::vector<std::optional<std::int64_t>> times_as_written(const ImportTable& in, const std::string& unit_name) {
  std::vector<std::optional<std::int64_t>> out(in.table.rows());
  const MappedColumn* time = find_meaning(in.map, "t");
  if (time == nullptr) {
    const double period_ns = 1e9 / in.rate_Hz;
    for (std::size_t i = 0; i < out.size(); ++i) out[i] = std::llround(static_cast<double>(i) * period_ns);
    return out;
  }
  const ImportUnit unit = parse_import_unit(unit_name.empty() ? time->unit : unit_name, Quantity::kTime, in.table.file);
  const MappedColumn* fine = find_meaning(in.map, "t2");
  const ImportUnit fine_unit = fine ? parse_import_unit(fine->unit, Quantity::kTime, in.table.file) : ImportUnit{};
  constexpr std::int64_t kFar_ns = std::int64_t{1} << 61;
  for (std::size_t row = 0; row < out.size(); ++row) {
    out[row] = time_of_cell(in, *time, unit, row);
    if (fine == nullptr || !out[row]) continue;
    const auto more = time_of_cell(in, *fine, fine_unit, row);
    if (!more || std::abs(*more) > kFar_ns || std::abs(*out[row]) > kFar_ns) {
      out[row].reset();
    } else {
      *out[row] += *more;
    }
  }
  return out;
}

// How far a clock may have gone on while it began again: 20 of the usual intervals, or 0.1 s.
std::int64_t longest_step_ns(const RowTimes& t_ns, const std::vector<std::size_t>& rows) {
  std::vector<std::int64_t> steps;
  for (std::size_t i = 1; i < rows.size(); ++i) {
    const std::int64_t step = *t_ns[rows[i]] - *t_ns[rows[i - 1]];
    if (step > 0) steps.push_back(step);
  }
  constexpr std::int64_t kLeast_ns = 100'000'000, kMostSteps = 20, kMost_ns = 60'000'000'000;
  if (steps.empty()) return kLeast_ns;
  const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
  std::nth_element(steps.begin(), middle, steps.end());
  return std::max(kLeast_ns, kMostSteps * std::min(*middle, kMost_ns / kMostSteps));
}

void continue_wraps(const ImportTable& in, RowTimes& t_ns, Problems& problems) {
  std::vector<std::size_t> rows;
  for (std::size_t row = 0; row < t_ns.size(); ++row) {
    if (t_ns[row]) rows.push_back(row);
  }
  const std::int64_t longest_ns = longest_step_ns(t_ns, rows);
  std::int64_t added_ns = 0;
  for (std::size_t i = 1; i < rows.size(); ++i) {
    const std::int64_t step_ns = *t_ns[rows[i]] - (*t_ns[rows[i - 1]] - added_ns);
    for (const ClockRange& range : kClockRanges) {
      if (step_ns >= 0 || step_ns + range.ns < 0 || step_ns + range.ns > longest_ns) continue;
      added_ns += range.ns;
      const Problem problem{
          "time_wrapped",
          fmt::format("{}: the clock begins again in line {}: from there on {} were added to the times", in.table.file,
                      in.table.row_line[rows[i]], range.name),
          1};
      if (std::none_of(problems.begin(), problems.end(),
                       [&](const Problem& p) { return p.message == problem.message; }))
        problems.push_back(problem);
      break;
    }
    *t_ns[rows[i]] += added_ns;
  }
}

}  // namespace

void fail_at(const DelimitedTable& table, std::size_t row, std::size_t column, const std::string& what) {
  throw Error(fmt::format("{}:{}: {}: '{}' {}", table.file, table.row_line[row], table.describe(column),
                          printable(table.cell(row, column)), what));
}

RowTimes read_row_times(const ImportTable& in, Problems& problems) {
  RowTimes out = times_as_written(in, {});
  if (find_meaning(in.map, "t") != nullptr) continue_wraps(in, out, problems);
  return out;
}

std::optional<TimeSpan> time_span(const ImportTable& in, const std::string& unit) {
  if (find_meaning(in.map, "t") == nullptr) return std::nullopt;
  try {
    Problems ignored;
    RowTimes times = times_as_written(in, unit);
    continue_wraps(in, times, ignored);
    std::optional<TimeSpan> out;
    for (const auto& t_ns : times) {
      if (!t_ns) continue;
      if (!out) out = TimeSpan{*t_ns, *t_ns, 0};
      out->from_ns = std::min(out->from_ns, *t_ns);
      out->to_ns = std::max(out->to_ns, *t_ns);
      ++out->rows;
    }
    return out && out->to_ns > out->from_ns ? out : std::nullopt;
  } catch (const Error&) {
    return std::nullopt;  // too large for this unit, or text
  }
}

}  // namespace asperity
