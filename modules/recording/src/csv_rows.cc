#include "csv_rows.h"

#include <algorithm>
#include <string_view>

#include "utf8_check.h"

namespace asperity {

std::string_view checked_lines(std::string_view text, const std::string& name) {
  require_utf8(text.substr(0, text.rfind('\n') + 1), name);
  return text;
}

std::optional<std::int64_t> row_time(const CsvReader& csv, std::size_t column, RowProblems& problems) {
  const std::string_view cell = csv.cell(column);
  if (cell.empty() || cell == "nan" || cell == "NaN") {
    problems.add("missing_time", csv.line(), "the row has no time and was left out");
    return std::nullopt;
  }
  const std::int64_t t_ns = csv.integer(column);
  if (t_ns < -kLatestTime_ns || t_ns > kLatestTime_ns) {
    problems.add("time_far_off", csv.line(),
                 "the time lies beyond a gap too long for one recording; such rows were left out");
    return std::nullopt;
  }
  return t_ns;
}

std::optional<Columns3> find3(const CsvReader& csv, const char* a, const char* b, const char* c) {
  if (!csv.find(a) && !csv.find(b) && !csv.find(c)) return std::nullopt;
  return require3(csv, a, b, c);
}

void note_truncation(const CsvReader& csv, RowProblems& problems) {
  if (csv.truncated()) {
    problems.add("truncated", csv.line() + 1, "the last line has no end, as after a power cut; it was left out");
  }
}

std::size_t most_rows(std::string_view text, std::size_t columns) {
  const auto lines = static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
  constexpr std::size_t kFilledCells = 4;
  return std::min(lines, text.size() / (columns + kFilledCells));
}

}  // namespace asperity
