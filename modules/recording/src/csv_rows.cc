#include "csv_rows.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>

#include <fmt/format.h>
#include "asperity/base/error.h"
#include "asperity/base/text.h"

namespace asperity {

namespace {

// The first byte above 0x7F at or after `from`; eight at a time, since nearly all text is ASCII.
std::size_t next_non_ascii(std::string_view text, std::size_t from) {
  constexpr std::uint64_t kHighBits = 0x8080808080808080u;
  std::uint64_t word = 0;
  while (from + sizeof word <= text.size()) {
    std::memcpy(&word, text.data() + from, sizeof word);
    if ((word & kHighBits) != 0) break;
    from += sizeof word;
  }
  while (from < text.size() && static_cast<unsigned char>(text[from]) < 0x80) ++from;
  return from;
}

// Throws Error naming the file and the line that is not UTF-8.
void require_utf8(std::string_view text, const std::string& name) {
  std::size_t at = 0;
  while ((at = next_non_ascii(text, at)) < text.size()) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    if (!is_utf8(text.substr(at, end - at))) {
      const auto line = std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n') + 1;
      throw Error(fmt::format("{}:{}: not UTF-8 text: {}", name, line, printable(text.substr(at, end - at))));
    }
    at = end;
  }
}

}  // namespace

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
                 "the time is beyond a gap that is too long for one recording; such rows were left out");
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
