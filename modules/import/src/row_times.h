#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "asperity/base/problem.h"
#include "asperity/import/import_table.h"

namespace asperity {

// Throws Error naming file, line, column and cell.
[[noreturn]] void fail_at(const DelimitedTable& table, std::size_t row, std::size_t column, const std::string& what);

// The time of each row, ns; nullopt: missing. One that goes back by a clock's range (2^32 µs, 2^32 ms, 24 h) from one
// row to the next, within 0.1 s or 20 intervals, is continued: Problem "time_wrapped". Throws Error as above.
std::vector<std::optional<std::int64_t>> read_row_times(const ImportTable& in, Problems& problems);

// From the first to the last, with the number of rows.
struct TimeSpan {
  std::int64_t from_ns = 0, to_ns = 0;
  std::size_t rows = 0;

  double length_s() const { return 1e-9 * static_cast<double>(to_ns - from_ns); }
};
// In another unit than the table's, if one is given. nullopt where a table has no time column, fewer than two times, or
// times that cannot be in the unit.
std::optional<TimeSpan> time_span(const ImportTable& in, const std::string& unit = {});

}  // namespace asperity
