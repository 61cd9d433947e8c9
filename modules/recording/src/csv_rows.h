#pragma once

#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "asperity/base/csv.h"
#include "asperity/base/error.h"
#include "time_order.h"

namespace asperity {

// `text`, once all its whole lines are known to be UTF-8. What follows the last newline is passed over
// by the reader, and may be anything. Throws Error with file and line.
std::string_view checked_lines(std::string_view text, const std::string& name);

// A cell as a number, nan where it is empty. Throws Error with file and line for other text.
inline double number_or_nan(const CsvReader& csv, std::size_t column) {
  return csv.empty(column) ? std::numeric_limits<double>::quiet_NaN() : csv.number(column);
}

// The row's time, or nullopt with a problem if there is none or it is absurd.
std::optional<std::int64_t> row_time(const CsvReader& csv, std::size_t column, RowProblems& problems);

using Columns3 = std::array<std::size_t, 3>;

inline Columns3 require3(const CsvReader& csv, const char* a, const char* b, const char* c) {
  return {csv.require(a), csv.require(b), csv.require(c)};
}

// All three or none; throws Error if only some are there.
std::optional<Columns3> find3(const CsvReader& csv, const char* a, const char* b, const char* c);

inline Eigen::Vector3d numbers3(const CsvReader& csv, const Columns3& columns) {
  return {number_or_nan(csv, columns[0]), number_or_nan(csv, columns[1]), number_or_nan(csv, columns[2])};
}

// No component is nan or beyond `limit`.
inline bool within(const Eigen::Vector3d& v, double limit) { return v.allFinite() && v.cwiseAbs().maxCoeff() <= limit; }

// Says that the last line was cut off, if it was.
void note_truncation(const CsvReader& csv, RowProblems& problems);

// After the last row: notes a cut-off line, puts the rows in order of time (`t_ns` and every column in
// `columns`; `line` holds each row's line) and hands what was noted to `problems`.
template <class... Columns>
void finish_rows(const CsvReader& csv, const std::vector<std::uint32_t>& line, const std::string& name,
                 const ReadLimits& limits, RowProblems& row_problems, Problems& problems,
                 std::vector<std::int64_t>& t_ns, Columns&... columns) {
  note_truncation(csv, row_problems);
  const RowOrder order = order_rows(t_ns, line, name, limits, row_problems);
  order.apply(t_ns);
  (order.apply(columns), ...);
  row_problems.append_to(problems);
}

// No fewer rows than `text` can hold, so that vectors grow once; each row has a cell a column, of which
// time and three numbers are not empty.
std::size_t most_rows(std::string_view text, std::size_t columns);

}  // namespace asperity
